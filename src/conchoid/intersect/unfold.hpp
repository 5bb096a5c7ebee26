#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// The unit vector whose smallest product with any of the given vectors is largest; of unit normals of the
/// triangles around a node, the side from which all are seen best. It points to the point of their convex
/// hull next to the origin. Zero if no direction has a positive product with all. For few vectors: O(n⁴).
Vec3 common_direction(const std::vector<Vec3>& vectors);

/// The sheet with its sharp folds smoothed out: a node whose triangles have no side in common from which all
/// are seen under less than about 75° goes to the middle of its neighbours (on the boundary: of those along
/// it), together with others, until there is none; after some rounds its neighbours go along, then theirs.
/// All other nodes stay bit for bit.
TriMesh unfolded(TriMesh sheet);

/// The embedded part (manifold_part.hpp) of a sheet without sharp folds: fit to cut a body. Where it passes through
/// itself within a few triangles these are smoothed out first, rather than left out: through a hole, however small,
/// the body would hang together.
TriMesh unfolded_part(const TriMesh& sheet);

}  // namespace conchoid
