#include "conchoid/io/panel_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "conchoid/io/stroke_font.hpp"

namespace conchoid {
namespace {

std::string rounded_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void draw_legend(Image& image, int x0, int width, double bottom, const std::string& name, const Vec2& range,
                 double size) {
  const int bar_width = width * 2 / 5, bar_height = static_cast<int>(0.8 * size);
  const int left = x0 + (width - bar_width) / 2, top = static_cast<int>(bottom) - bar_height;
  for (int x = 0; x < bar_width; ++x)
    for (int y = 0; y < bar_height; ++y)
      image.set(left + x, top + y, scalar_color((x + 0.5) / bar_width));
  const TextStyle style{0.8 * size, 0.12, {0.30f, 0.32f, 0.35f}};
  const TextStyle small{0.6 * size, 0.12, style.color};
  const std::string low = rounded_number(range[0]), high = rounded_number(range[1]);
  draw_text(image, left - text_width(low, style) - 0.7 * size, bottom, low, style);
  draw_text(image, left + bar_width + 0.7 * size, bottom, high, style);
  if (range[1] > range[0]) {
    const std::string middle = rounded_number(0.5 * (range[0] + range[1]));
    for (int y = 0; y < bar_height; ++y)
      image.blend(left + bar_width / 2, top + y, {1, 1, 1}, 0.6);
    draw_text(image, left + 0.5 * (bar_width - text_width(middle, small)), bottom + 1.1 * size, middle,
              small);
  }
  draw_text(image, left + 0.5 * (bar_width - text_width(name, style)), top - 0.7 * size, name, style);
}

/// Text in the middle of a panel, made smaller if it would not fit.
void draw_centered(Image& image, int x0, int width, double base_line, const std::string& text,
                   TextStyle style) {
  const double room = 0.94 * width, needed = text_width(text, style);
  if (needed > room) style.cap_height *= room / needed;
  draw_text(image, x0 + 0.5 * (width - text_width(text, style)), base_line, text, style);
}

bool has_legend(const PicturePanel& panel) {
  return panel.legend && std::any_of(panel.meshes.begin(), panel.meshes.end(),
                                     [](const PictureMesh& m) { return !m.node_value.empty(); });
}

}  // namespace

Vec2 value_range(const std::vector<PicturePanel>& panels, const std::string& name) {
  Vec2 range(1e300, -1e300);
  for (const PicturePanel& panel : panels)
    if (panel.value_name == name)
      for (const PictureMesh& mesh : panel.meshes)
        for (double v : mesh.node_value)
          if (std::isfinite(v)) range = {std::min(range[0], v), std::max(range[1], v)};
  return range[0] <= range[1] ? range : Vec2(0, 1);
}

Vec2 label_room(const PicturePanel& panel, double size) {
  return {panel.title.empty() ? 0.0 : 4.2 * size,
          (panel.caption.empty() ? 0.0 : 3.4 * size) + (has_legend(panel) ? 4.2 * size : 0.0)};
}

void draw_labels(Image& image, const PicturePanel& panel, const PixelArea& area, const Vec2& range,
                 double size) {
  const int x0 = area.left, width = area.right - area.left;
  draw_centered(image, x0, width, area.top + 2.7 * size, panel.title, {size, 0.15, {0.15f, 0.17f, 0.20f}});
  draw_centered(image, x0, width, area.bottom - 1.6 * size, panel.caption,
                {0.78 * size, 0.12, {0.36f, 0.38f, 0.41f}});
  if (has_legend(panel))
    draw_legend(image, x0, width, area.bottom - (panel.caption.empty() ? 1.6 : 4.0) * size, panel.value_name,
                range, size);
}

}  // namespace conchoid
