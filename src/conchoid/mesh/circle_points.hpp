#pragma once

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Point j of n ones evenly spaced by arc length on an ellipse with semi-axes a (along x) and b, from (a, 0)
/// counter-clockwise. Mirror images in the axes agree bit for bit, for a circle also those in the diagonals,
/// which (a cos φ, b sin φ) of φ = j·2π/n would not promise.
Vec2 ellipse_point(int j, int n, double a, double b);

/// Circumference of an ellipse [m].
double ellipse_perimeter(double a, double b);

}  // namespace conchoid
