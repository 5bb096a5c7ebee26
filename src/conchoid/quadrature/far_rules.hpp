#pragma once

namespace conchoid {

/// Lowest degree of a triangle rule that integrates the kernel over a panel of that radius, seen from points
/// no closer to its center than `distance`, to the relative tolerance; 0 when no rule does.
int far_degree(double radius, double distance, double tolerance);

}  // namespace conchoid
