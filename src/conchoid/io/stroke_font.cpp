#include "conchoid/io/stroke_font.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {
namespace {

/// A glyph is a list of strokes, a stroke a list of points "xy" on a grid: base line y = 2, small letters up
/// to 6, capitals up to 8, descenders down to 0. '~' before a stroke rounds it (quadratic B-spline that keeps
/// its ends), '@' also closes it. One point alone is a dot.
struct Glyph {
  char32_t code;
  const char* strokes;
};

constexpr Glyph glyphs[] = {
    {'A', "023862 1454"},
    {'B', "0208 ~083858553505 ~053565623202"},
    {'C', "~676808026263"},
    {'D', "0208 ~082858522202"},
    {'E', "58080252 0545"},
    {'F', "580802 0545"},
    {'G', "~67680802626465 6545"},
    {'H', "0208 6268 0565"},
    {'I', "0208"},
    {'J', "~4845420204"},
    {'K', "0208 0558 1652"},
    {'L', "080252"},
    {'M', "0208346862"},
    {'N', "02086268"},
    {'O', "@68620208"},
    {'P', "0208 ~083858543404"},
    {'Q', "@68620208 4361"},
    {'R', "0208 ~083858553505 2552"},
    {'S', "~5758080555520203"},
    {'T', "0868 3832"},
    {'U', "~080502626568"},
    {'V', "083268"},
    {'W', "0822476288"},
    {'X', "0862 0268"},
    {'Y', "083568 3532"},
    {'Z', "08680262"},
    {'a', "@46420206 4642"},
    {'b', "@46420206 0802"},
    {'c', "~454606024243"},
    {'d', "@46420206 4842"},
    {'e', "0444 ~444606024243"},
    {'f', "~38181612 0636"},
    {'g', "@46420206 ~4642400001"},
    {'h', "0802 ~0406464442"},
    {'i', "0602 08"},
    {'j', "~16131000 18"},
    {'k', "0802 4604 2542"},
    {'l', "0802"},
    {'m', "0602 ~0406363432 ~3436666462"},
    {'n', "0602 ~0406464442"},
    {'o', "@46420206"},
    {'p', "@46420206 0600"},
    {'q', "@46420206 4640"},
    {'r', "0602 ~04062636"},
    {'s', "~4546060444420203"},
    {'t', "~18141232 0636"},
    {'u', "~060402424446 4642"},
    {'v', "062246"},
    {'w', "0612356266"},
    {'x', "0642 0246"},
    {'y', "0622 4610"},
    {'z', "06460242"},
    {'0', "@48420208"},
    {'1', "072822"},
    {'2', "~0708484502 0242"},
    {'3', "~0708484515 ~1545420203"},
    {'4', "32380454"},
    {'5', "480805 ~050646420203"},
    {'6', "@46420206 ~480804"},
    {'7', "084812"},
    {'8', "@48450508 @45420205"},
    {'9', "@48440408 ~464202"},
    {'.', "02"},
    {',', "1200"},
    {':', "02 05"},
    {';', "12 15 1200"},
    {'-', "0434"},
    {'_', "0151"},
    {'+', "0444 2226"},
    {'=', "0545 0343"},
    {'/', "0148"},
    {'\\', "0841"},
    {'|', "0109"},
    {'(', "~29070321"},
    {')', "~09272301"},
    {'[', "29090121"},
    {']', "09292101"},
    {'<', "460442"},
    {'>', "064402"},
    {'\'', "0806"},
    {'"', "0806 2826"},
    {'!', "0804 02"},
    {'?', "~070848452524 22"},
    {'*', "2428 0547 0745"},
    {'%', "0268 @08282606 @44646242"},
    {'#', "1218 3238 0444 0646"},
    {'&', "~520608383604022254"},
    {'^', "062846"},
    {'~', "~0416253446"},
    {0xB0, "@08282606"},                      // °
    {0xB7, "05"},                             // ·
    {0xD7, "0337 0733"},                      // ×
    {0xB2, "~08282605 0525"},                 // ²
    {0xB3, "~08282616 ~16262404"},            // ³
    {0x2013, "0454"},                         // –
    {0x2014, "0474"},                         // —
    {0x2192, "0464 456443"},                  // →
    {0x221A, "0415224878"},                   // √
    {0x3B1, "@46420206 ~464352"},             // α
    {0x3B2, "0007 ~0708383505 ~0545422202"},  // β
    {0x3BC, "0600 ~060402424446 4642"},       // μ
    {0x3BD, "0622 ~224446"},                  // ν
    {0x3C3, "@46420206 2656"},                // σ
    {0x3C4, "0646 ~262432"},                  // τ
};

constexpr double base_line = 2, grid_cap_height = 6, letter_gap = 1.9, space_width = 2.2;
constexpr const char* unknown_glyph = "0208484202";

const char* strokes_of(char32_t code) {
  for (const Glyph& glyph : glyphs)
    if (glyph.code == code) return glyph.strokes;
  return unknown_glyph;
}

std::vector<char32_t> decoded(std::string_view utf8) {
  std::vector<char32_t> codes;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i++]);
    const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
    char32_t code = more == 3 ? lead & 7u : more == 2 ? lead & 15u : more == 1 ? lead & 31u : lead;
    for (int k = 0; k < more && i < utf8.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(utf8[i++]) & 63u);
    codes.push_back(code);
  }
  return codes;
}

using Polyline = std::vector<Vec2>;

/// Quadratic B-spline through the midpoints of the control polygon; an open one begins and ends at its first
/// and last point.
Polyline rounded(const Polyline& control, bool closed) {
  constexpr int steps = 8;
  const std::size_t n = control.size();
  if (n < 3) return control;
  Polyline out;
  const auto arc = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    for (int i = 0; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      out.push_back((1 - s) * (1 - s) * a + 2 * s * (1 - s) * b + s * s * c);
    }
  };
  const auto middle = [&](std::size_t i) { return Vec2(0.5 * (control[i % n] + control[(i + 1) % n])); };
  if (closed) {
    for (std::size_t i = 0; i < n; ++i)
      arc(middle(i), control[(i + 1) % n], middle(i + 1));
  } else {
    for (std::size_t i = 1; i + 1 < n; ++i)
      arc(i == 1 ? control[0] : middle(i - 1), control[i], i + 2 == n ? control[n - 1] : middle(i));
  }
  return out;
}

struct Shape {
  std::vector<Polyline> strokes;
  double width = 0;
};

Shape shape_of(char32_t code) {
  Shape shape;
  if (code == ' ') {
    shape.width = space_width;
    return shape;
  }
  for (const char* p = strokes_of(code); *p;) {
    if (*p == ' ') {
      ++p;
      continue;
    }
    const bool closed = *p == '@', round = closed || *p == '~';
    if (round) ++p;
    Polyline stroke;
    for (; *p && *p != ' '; p += 2) {
      stroke.push_back(Vec2(p[0] - '0', p[1] - '0'));
      shape.width = std::max(shape.width, stroke.back().x());
    }
    shape.strokes.push_back(round ? rounded(stroke, closed) : stroke);
  }
  return shape;
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& x) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (a + s * ab - x).norm();
}

void draw_shape(Image& image, const std::vector<Polyline>& strokes, double half_width, const Color& color) {
  Vec2 low = strokes[0][0], high = low;
  for (const Polyline& stroke : strokes)
    for (const Vec2& p : stroke) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double margin = half_width + 1;
  for (int y = static_cast<int>(std::floor(low.y() - margin)); y <= std::ceil(high.y() + margin); ++y)
    for (int x = static_cast<int>(std::floor(low.x() - margin)); x <= std::ceil(high.x() + margin); ++x) {
      double distance = margin + 1;
      for (const Polyline& stroke : strokes)
        for (std::size_t i = 0; i < stroke.size(); ++i)
          distance =
              std::min(distance, distance_to_segment(stroke[i], stroke[std::min(i + 1, stroke.size() - 1)],
                                                     Vec2(x + 0.5, y + 0.5)));
      image.blend(x, y, color, std::clamp(half_width + 0.5 - distance, 0.0, 1.0));
    }
}

}  // namespace

double text_width(std::string_view text, const TextStyle& style) {
  double width = 0;
  const std::vector<char32_t> codes = decoded(text);
  for (char32_t code : codes)
    width += shape_of(code).width + letter_gap;
  return codes.empty() ? 0 : (width - letter_gap) * style.cap_height / grid_cap_height;
}

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
  const double scale = style.cap_height / grid_cap_height;
  for (char32_t code : decoded(text)) {
    Shape shape = shape_of(code);
    for (Polyline& stroke : shape.strokes)
      for (Vec2& p : stroke)
        p = Vec2(x + scale * p.x(), y - scale * (p.y() - base_line));
    if (!shape.strokes.empty())
      draw_shape(image, shape.strokes, 0.5 * style.weight * style.cap_height, style.color);
    x += scale * (shape.width + letter_gap);
  }
}

}  // namespace conchoid
