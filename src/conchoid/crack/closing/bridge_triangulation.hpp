#pragma once

#include <array>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Triangles between two stretches of boundary that face each other, both in the order in which the triangles
/// behind them walk: of all ways to go along both the one with the best shapes and the fewest folds; of
/// equals the one with diagonals at smaller ids. first.front() lies opposite second.back(); where they are
/// the same node, or the other two ends are, no triangle stands there.
/// @param normals  unit, per node, of the meshes behind the stretches
std::vector<std::array<NodeId, 3>> triangles_between(const IdVector<NodeId, Vec3>& positions,
                                                     const IdVector<NodeId, Vec3>& normals,
                                                     const std::vector<NodeId>& first,
                                                     const std::vector<NodeId>& second);

/// Whether a triangle stands across the normals of its nodes, or against them.
bool folds(const IdVector<NodeId, Vec3>& positions, const IdVector<NodeId, Vec3>& normals,
           const std::array<NodeId, 3>& triangle);

}  // namespace conchoid
