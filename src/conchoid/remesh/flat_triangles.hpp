#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Height over longest edge at which a triangle has no area (validate.hpp).
inline constexpr double flattest_triangle = 1e-10;

bool has_no_area(const Triangle& triangle);
bool has_flat_triangle(const TriMesh& mesh);

/// Turns over the longest edges of triangles without area whose third node lies on that edge (T-junctions): the
/// neighbour there is divided at that node, and no point moves. Longest first; where the edge has no second
/// triangle, or the new edge is there already, or where two nodes of a triangle coincide, it stays as it is. Returns
/// how many were turned over.
/// @param mesh  triangle ids stay
std::size_t flip_flat_triangles(TriMesh& mesh);

struct FlatTrianglesRemoved {
  std::size_t flipped = 0;  ///< triangles
  std::size_t welded = 0;   ///< nodes
};

/// Takes triangles without area out: nodes that coincide but for round-off become one, the others are turned over, in turns, as
/// one brings about the other.
FlatTrianglesRemoved remove_flat_triangles(TriMesh& mesh);

}  // namespace conchoid
