#pragma once

#include <utility>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// All pairs (triangle of a, triangle of b) whose axis-aligned boxes meet (touching counts), sorted.
std::vector<std::pair<TriId, TriId>> overlapping_boxes(const TriMesh& a, const TriMesh& b);

}  // namespace conchoid
