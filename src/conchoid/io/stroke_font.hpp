#pragma once

#include <string_view>

#include "conchoid/io/image.hpp"

namespace conchoid {

/// Text drawn as round-tipped strokes, smooth at any size. UTF-8; knows ASCII and a few signs of the field (°
/// · × √ ² ³ – α β μ ν σ τ).
struct TextStyle {
  double cap_height = 14;  ///< height of a capital letter [pixel]
  double weight = 0.13;    ///< stroke width as a share of the capital height
  Color color{0.16f, 0.18f, 0.21f};
};

/// Width of the text [pixel].
double text_width(std::string_view text, const TextStyle& style);
/// Draws with the left end of the base line at (x, y) [pixel, from the top left].
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style);

}  // namespace conchoid
