#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Height over longest edge at which a triangle has no area (validate.hpp).
inline constexpr double flattest_triangle = 1e-10;

/// Turns over the longest edges of triangles without area whose third node lies on that edge (T-junctions): the
/// neighbour there is divided at that node, and no point moves. Longest first; where the edge has no second
/// triangle, or the new edge is there already, a triangle stays as it is. Returns how many were turned over.
/// @param mesh  triangle ids stay
std::size_t flip_flat_triangles(TriMesh& mesh);

}  // namespace conchoid
