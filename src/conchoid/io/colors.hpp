#pragma once

#include <array>
#include <cstdint>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// sRGB colour, components 0…1.
struct Color {
  float r = 0, g = 0, b = 0;
};

/// The two materials of every picture and 3D file: the body's skin is light grey, what broke is warm.
inline constexpr Color original_color{0.80f, 0.82f, 0.84f};
inline constexpr Color fracture_color{0.80f, 0.50f, 0.34f};
inline constexpr Color color_of(FaceKind kind) {
  return kind == FaceKind::original ? original_color : fracture_color;
}

/// Components rounded to 0…255.
std::array<std::uint8_t, 3> to_bytes(const Color& color);
/// sRGB component to linear light and back.
float to_linear(float component);
float from_linear(float light);

/// Perceptually ordered colour map for scalars: dark violet (0) over magenta and orange to light yellow (1).
Color scalar_color(double value);

}  // namespace conchoid
