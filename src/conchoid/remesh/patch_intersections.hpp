#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Cuts out the triangles of a closed surface that pass through others, with `rings` rings of neighbours, and
/// closes what is left by triangulations of its rims without new nodes. Scraps that come off (less than a tenth
/// of the area of the largest part left of the same part) are dropped. Whether the result is good is for
/// find_defects to say.
/// @return how many triangles were cut out; 0 where nothing intersects, or where more than `most` of the area
/// would go
std::size_t patch_intersections(TriMesh& mesh, int rings, double most = 0.2);

/// Closes holes: rims of edges with a single triangle each. No new nodes; no edge becomes a second one between
/// its nodes. Returns how many.
std::size_t close_holes(TriMesh& mesh);

}  // namespace conchoid
