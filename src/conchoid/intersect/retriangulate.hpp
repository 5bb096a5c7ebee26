#pragma once

#include <array>
#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A triangle with nodes on its edges and inside it, and the curves that must become edges of its pieces.
struct TriangleCut {
  std::array<NodeId, 3> corners;  ///< ascending ids
  std::array<std::vector<NodeId>, 3>
      on_edge;                 ///< nodes on edge (corner k, corner k+1), in that direction, corners left out
  std::vector<Edge> segments;  ///< each once
  std::vector<std::array<NodeId, 3>>
      through;  ///< nodes where curves cross: (node before, crossing node, node after), per curve

  /// Exact sense of the turn before → node → after of a curve at an inner node: +1 left, −1 right, seen so
  /// that the corners go round counter-clockwise; 0: not known. Asked where the curve seems to double back on
  /// itself: only this tells a slit from a needle.
  std::function<int(NodeId before, NodeId node, NodeId after)> turn;
};

/// Two segments that have to meet in a node, because the curves they belong to join nodes of the rim that
/// alternate.
struct CrossingSegments {
  Edge first, second;
};

/// Curves of an embedded sheet never cross; those of one that passes through itself do. Empty in the first
/// case. Decided by the order of the nodes on the rim alone; which segments of the two curves are to meet, by
/// coordinates.
std::vector<CrossingSegments> crossing_segments(const IdVector<NodeId, Vec3>& positions,
                                                const TriangleCut& cut);

/// Pieces of the triangle, corners in the sense of `cut.corners`: its triangulation with exactly the given
/// nodes, containing all segments.
///
/// Which piece touches which follows from the order of the nodes along the edges and from the segments alone;
/// coordinates only choose among the triangulations that are possible so, best shape first. Nodes that
/// coincide or are out of line by round-off therefore cost nothing worse than a piece without area. Ties go
/// to the lower node id. The result is the same for a rotated, reflected or scaled triangle.
/// @throws ComputationError if segments cross each other outside nodes
std::vector<std::array<NodeId, 3>> retriangulate(const IdVector<NodeId, Vec3>& positions,
                                                 const TriangleCut& cut);

}  // namespace conchoid
