#pragma once

#include "conchoid/bem/quadratic_body.hpp"

namespace conchoid {

/// Stress [Pa] on the surface at barycentric coordinates of a triangle, the load's ambient field included: (T1) with
/// the gradient of the quadratic displacement there.
Mat3 surface_stress(const QuadraticSolution& solution, TriId triangle, const Vec3& barycentric);

}  // namespace conchoid
