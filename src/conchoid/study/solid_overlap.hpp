#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Volume of the intersection over volume of the union of two closed meshes: 1 for the same solid, 0 for
/// disjoint ones (and for two empty ones: NaN). Measured along lines parallel to each axis, `lines` × `lines`
/// of them through the common bounding box, exact along each line.
double intersection_over_union(const TriMesh& a, const TriMesh& b, int lines = 96);

/// Overlap of the largest pieces of two broken bodies: the largest piece of `a` with the piece of `b` that it
/// overlaps best, and the other way round, averaged. Pieces are sorted largest first. NaN where one of the
/// bodies has no pieces.
double largest_fragment_overlap(const std::vector<TriMesh>& a, const std::vector<TriMesh>& b, int lines = 96);

}  // namespace conchoid
