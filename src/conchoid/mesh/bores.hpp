#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A hole through a body, or a round cavity in it.
struct Bore {
  Vec3 center;        ///< of its wall [m]
  double radius = 0;  ///< mean distance of the wall from its middle, along its normals [m]
};

/// The bores of a closed surface, in the order of their first triangles: connected triangles, at least six, between
/// which the surface bends inward by less than 60°, whose normals point at each other around the middle. Blunt notches,
/// fillets and the folds of a scan do not close around a middle and are none.
std::vector<Bore> bores(const TriMesh& surface);

}  // namespace conchoid
