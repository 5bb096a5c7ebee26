#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Whether the sheet covers a coordinate plane at most once, when seen along the axis across which most of it lies: then it passes
/// nowhere through itself. What crack sheets do mostly, and is told without looking for pairs of triangles that meet:
/// where all triangles are seen from the same side, as many of them lie above a point as boundaries wind around it, so that is
/// one at most where the boundaries do not meet and but one of them winds that way. Decided by exact signs.
/// False for anything else: closed surfaces, boundaries that meet in a node.
bool covers_plane_once(const TriMesh& sheet);

}  // namespace conchoid
