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
/// centroid c are spread as: F/A + (J⁻¹ M) × (x − c), of which the part in the free directions acts, P their projection:
/// J = Σ A_t [d]× P [d]×ᵀ, d = x_t − c. The resultant of that part is exactly P F and M.
/// Errors: InputError when there is a moment about a direction in which no such traction turns: the centres of the region's
/// triangles lie on a line along it, or what turns is held.
LinearTraction spread_force(const TriMesh& surface, const Region& region, const BoundaryCondition& condition);

}  // namespace conchoid
