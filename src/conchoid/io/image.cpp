#include "conchoid/io/image.hpp"

#include <algorithm>
#include <cmath>

namespace conchoid {

void Image::set(int x, int y, const Color& color) {
  const auto bytes = to_bytes(color);
  std::copy(bytes.begin(), bytes.end(), pixel(x, y));
}

void Image::blend(int x, int y, const Color& color, double coverage) {
  if (x < 0 || y < 0 || x >= width || y >= height || !(coverage > 0)) return;
  const auto bytes = to_bytes(color);
  std::uint8_t* p = pixel(x, y);
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = static_cast<std::uint8_t>(std::lround(p[i] + std::min(coverage, 1.0) * (bytes[i] - p[i])));
}

}  // namespace conchoid
