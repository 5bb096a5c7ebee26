#pragma once

#include "conchoid/mesh/regions.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// Tractions that vary linearly over a region: t(x) = traction + twist × (x − about) [Pa].
struct LinearTraction {
  Vec3 traction;  ///< [Pa]
  Vec3 twist;     ///< [Pa/m]
  Vec3 about;     ///< [m]

  Vec3 at(const Vec3& x) const { return traction + cross(twist, x - about); }
};

/// The tractions, constant per triangle and taken at its centre, that a force and a moment about the region's
/// centroid c are spread as: F/A + (J⁻¹ M) × (x − c), J = Σ A_t (|d|² I − d dᵀ), d = x_t − c. Their resultant is
/// exactly F and M.
/// Errors: InputError when the centres of the region's triangles lie on a line about which there is a moment.
LinearTraction spread_force(const TriMesh& surface, const Region& region, const BoundaryCondition& condition);

}  // namespace conchoid
