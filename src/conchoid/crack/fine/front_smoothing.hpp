#pragma once

#include "conchoid/crack/fine/marker_curve.hpp"

namespace conchoid {

/// Where the front would pass marker i if it had no detail finer than `width`: the mean of the curve around
/// it by arc length s with the weight ⁴⁄₃ hat(s/width) − ⅓ hat(s/2 width), exact for quadratic curves, so
/// that a smooth front stays what it is. The width is reduced near the ends of an open curve (the end itself
/// stays) and on rings shorter than 4 widths.
Vec3 smoothed_position(const MarkerCurve& curve, std::size_t i, double width);

/// The same for all markers.
std::vector<Vec3> smoothed_positions(const MarkerCurve& curve, double width);

/// Takes the differences between neighbours out of a quantity along the front: (1, 2, 1)/4 twice, among
/// markers in a row that take part.
void smooth_along(const MarkerCurve& curve, const std::vector<bool>& takes_part, std::vector<double>& values);

}  // namespace conchoid
