#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// How often a closed surface winds around x: sum of the solid angles of its triangles over 4π. 1 inside a
/// body oriented outward, 0 outside, a value in between near the holes of an open one.
double winding_number(const TriMesh& surface, const Vec3& x);

}  // namespace conchoid
