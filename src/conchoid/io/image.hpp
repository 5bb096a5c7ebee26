#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "conchoid/io/colors.hpp"

namespace conchoid {

/// 8-bit sRGB image, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint8_t* pixel(int x, int y) {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
  const std::uint8_t* pixel(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
  void set(int x, int y, const Color& color);
  /// Mixes `color` over the pixel; nothing outside the image.
  void blend(int x, int y, const Color& color, double coverage);
};

void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace conchoid
