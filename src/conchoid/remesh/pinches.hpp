#pragma once

#include <cstddef>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// How far the copies of a node are drawn into their parts, as a share of the shortest edge around.
inline constexpr double pinch_gap = 1e-4;

/// Takes apart what only touches: at an edge with more than two triangles, those on both sides of one wedge of
/// the inside stay together; a node whose triangles form several fans becomes one node for each, and these are
/// drawn apart a little (pinch_gap): into their part where parts touch from outside, out of it where hollows
/// touch in it.
/// @return how many nodes were added
std::size_t split_pinches(TriMesh& mesh);

/// Likewise at edges with more than two triangles both nodes of which are tips of what opens there, so that no node can be
/// divided: a node in the middle of the edge for each wedge of the inside, and its two triangles halved.
/// @param halved  of each triangle that is added, behind the others: the one that it is a half of
/// @return how many nodes were added
std::size_t part_edges(TriMesh& mesh, std::vector<TriId>& halved);

}  // namespace conchoid
