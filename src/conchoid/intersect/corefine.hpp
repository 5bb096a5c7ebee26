#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A closed surface and the part of an open sheet inside it, cut along the curve where they meet so that both
/// use the same nodes there: a mouth edge has two surface triangles and one sheet triangle.
struct CutComplex {
  IdVector<NodeId, Vec3> positions;  ///< the surface's own nodes first, unchanged (same ids, same bits); then
                                     ///< nodes of the sheet and of the mouth
  std::size_t surface_node_count = 0;   ///< how many of them are the surface's own
  IdVector<NodeId, NodeId> sheet_node;  ///< per node: the sheet's node it is, or invalid

  IdVector<TriId, std::array<NodeId, 3>>
      surface;  ///< all surface triangles: uncut ones first-hand, cut ones as pieces; orientation kept
  std::vector<TriId> surface_parent;             ///< per surface piece: triangle of the input surface
  IdVector<TriId, std::array<NodeId, 3>> sheet;  ///< pieces of the sheet inside; orientation kept
  std::vector<TriId> sheet_parent;               ///< per sheet piece: triangle of the input sheet

  std::vector<Edge> mouth;  ///< edges where sheet and surface meet, sorted
};

struct CorefineSettings {
  /// Mouth edges and nodes closer than this fraction of the local edge length are merged (onto the surface's
  /// own node where one is near), so that no sliver spoils a boundary element system. 0: geometry exactly as
  /// it intersects.
  double merge = 0.0;
  /// Likewise, how far a node may leave the plane of the sheet for that: the sheet is bent there.
  double across = 1.0;
};

/// Cuts `surface` (closed, manifold, oriented outward) by `sheet` (open manifold, may stick out, may have
/// several parts). Nothing but combinatorics and the coordinates themselves decide; no tolerance in world
/// units; same input, same bits.
CutComplex corefine(const TriMesh& surface, const TriMesh& sheet, const CorefineSettings& settings = {});

/// Two closed surfaces, each cut along the curves where they meet.
struct SplitSurfaces {
  struct Piece {
    std::array<NodeId, 3> corners;  ///< orientation kept
    bool inside;                    ///< of the other surface
  };
  IdVector<NodeId, Vec3> positions;  ///< nodes of the first, nodes of the second, nodes of the curves
  std::vector<Piece> first, second;
};

/// Cuts two closed surfaces (manifold, oriented outward) by each other, in general position after the same
/// perturbation as corefine's: where they touch, the second reaches into the first.
SplitSurfaces split_by_each_other(const TriMesh& first, const TriMesh& second);

}  // namespace conchoid
