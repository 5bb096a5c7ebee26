#pragma once

#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A curve on the boundary of a mesh and where its nodes go. Nodes in order along e3: each edge (i, i+1) is
/// walked in this direction by the triangle it belongs to.
struct StripCurve {
  std::vector<NodeId> nodes;
  bool closed = false;
  std::vector<Vec3> target;  ///< new position per node; read where `moved`
  std::vector<bool> moved;   ///< the others stay and remain part of the new curve
  std::vector<bool> pinned;  ///< may be empty. A merged node takes the position of its pinned member; two
                             ///< pinned nodes never merge
};

struct StripSettings {
  double split_above = 0;  ///< edges of the new curve longer than this [m] get nodes in between
  double collapse_below =
      0;  ///< edges shorter than this [m] between two moved nodes, or turned round, merge their nodes
  double close_below =
      0;  ///< a shrinking ring with all of its nodes moved closes when it lies within this radius [m]
  /// Position of a node put in between the moved (or kept) nodes a and b of the old curve at fraction s; for
  /// a merged run its first and last node and s = ½. Empty: on the straight edge; the mean.
  std::function<Vec3(std::size_t a, std::size_t b, double s)> between = {};
};

/// One node of the new curve and the positions in the old curve it stems from.
struct StripNode {
  enum class Kind : std::uint8_t {
    kept,      ///< the old node itself (first = last)
    moved,     ///< new node of first = last
    merged,    ///< one new node for the run first … last (round the ring if last < first)
    inserted,  ///< between the successors of first and last, at fraction s
  };
  NodeId id;
  Kind kind = Kind::kept;
  std::size_t first = 0, last = 0;
  double s = 0;
};

struct Strip {
  std::vector<StripNode> curve;  ///< the new curve, in the order of the old one; empty if it has closed
  bool closed = false;           ///< as the old one
};

/// Appends the strip between the old and the new curve: two triangles per moved edge (one where only one end
/// moved), the shorter diagonal, at equal length (1e-6) the one at the old node with the smaller id, the
/// other one if a triangle would be turned over. Ids depend on old ids only, never on the direction of the
/// walk or on coordinates: a mirrored curve gets the mirrored strip. No triangle is degenerate or turned
/// over: where that would happen, the displacements involved are halved, in the end not carried out.
Strip append_strip(TriMesh& mesh, const StripCurve& curve, const StripSettings& settings);

}  // namespace conchoid
