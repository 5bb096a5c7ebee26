#pragma once

#include <utility>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Whether triangles s and t meet elsewhere than in nodes and edges they share. Touching counts as meeting.
/// Exact: decided by the signs of determinants of the coordinates. Both must be free of repeated nodes.
bool triangles_intersect(const TriMesh& mesh, TriId s, TriId t);

/// The same for two triples of nodes.
bool triangles_intersect(const IdVector<NodeId, Vec3>& positions, std::array<NodeId, 3> a,
                         std::array<NodeId, 3> b);

/// The first `limit` pairs of triangles that intersect, s < t, ascending.
std::vector<std::pair<TriId, TriId>> self_intersections(const TriMesh& mesh, std::size_t limit);

/// Likewise of pairs that hold one of the faces (ascending), by looking around these alone.
std::vector<std::pair<TriId, TriId>> self_intersections(const TriMesh& mesh, const std::vector<TriId>& faces,
                                                        std::size_t limit);

}  // namespace conchoid
