#include "conchoid/io/colors.hpp"

#include <algorithm>
#include <cmath>

namespace conchoid {

std::array<std::uint8_t, 3> to_bytes(const Color& color) {
  const auto byte = [](float c) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(c, 0.0f, 1.0f)));
  };
  return {byte(color.r), byte(color.g), byte(color.b)};
}

float to_linear(float component) {
  return component <= 0.04045f ? component / 12.92f : std::pow((component + 0.055f) / 1.055f, 2.4f);
}

float from_linear(float light) {
  return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
}

Color scalar_color(double value) {
  static constexpr std::array<Color, 9> table{{{0.19f, 0.11f, 0.36f},
                                               {0.30f, 0.14f, 0.50f},
                                               {0.45f, 0.17f, 0.55f},
                                               {0.60f, 0.20f, 0.54f},
                                               {0.75f, 0.26f, 0.48f},
                                               {0.88f, 0.35f, 0.38f},
                                               {0.96f, 0.50f, 0.28f},
                                               {0.99f, 0.69f, 0.30f},
                                               {0.99f, 0.89f, 0.52f}}};
  if (!(value > 0)) return table.front();
  const double at = std::min(value, 1.0) * (table.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), table.size() - 2);
  const float s = static_cast<float>(at - static_cast<double>(i));
  const Color &p = table[i], &q = table[i + 1];
  return {p.r + s * (q.r - p.r), p.g + s * (q.g - p.g), p.b + s * (q.b - p.b)};
}

}  // namespace conchoid
