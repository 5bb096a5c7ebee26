#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Area of a body's section with a plane [m²]: of the connected part of it that a point of the plane lies in or next to.
/// Nodes on the plane count as above it. Linear in the triangles. 0 where the plane passes the body by.
/// @param surface  closed, outward
double section_area(const TriMesh& surface, const Vec3& point, const Vec3& unit_normal);

}  // namespace conchoid
