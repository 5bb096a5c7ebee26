#pragma once

#include <functional>
#include <vector>

#include "conchoid/crack/front/front.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

/// active: inside the body, may move. arrested: stays for good (another front or crack in its way). outside:
/// beyond the body's surface, drawn along by active neighbours. Kept by the caller except where noted; new
/// nodes inherit it.
enum class FrontState : std::uint8_t { active, arrested, outside };

struct SheetFront {
  std::vector<NodeId> nodes;  ///< in order along e3 (see front.hpp); a closed front starts at its smallest id
  bool closed = false;
};

/// The boundary element crack mesh as it grows, one sheet for all cracks (its parts). Nodes may lie outside
/// of the body: the sheet is trimmed by the surface later. Nodes and triangles are only ever appended, never
/// moved or renumbered.
struct CrackSheet {
  TriMesh mesh;
  std::vector<SheetFront> fronts;
  IdVector<NodeId, FrontState> state;  ///< of the nodes on a front; what it was last for the others
  IdVector<NodeId, NodeId>
      correlation;  ///< of the nodes on a front: the node right behind; the old front node it came from, at
                    ///< the start the interior node of a triangle with a front edge; invalid if there is none
  IdVector<NodeId, double> travelled;  ///< path length of the front from the initial crack to the node [m]
  IdVector<NodeId, int> node_birth;    ///< frame in which it appeared
  IdVector<TriId, int> triangle_birth;
  int frame = 0;  ///< number of advances so far
};

/// Adds a crack (a manifold with boundary, normals consistent); its boundary edges that are not mouth edges
/// are its fronts, all nodes active. @param mouth  sorted edges of `part` that never move; empty for sheets
/// that stick out of the body
/// @return id of its first node: node k of the part becomes node first + k, likewise the triangles
NodeId append_part(CrackSheet& sheet, const TriMesh& part, const std::vector<Edge>& mouth = {});

/// The part turned so that its normals, in the mean, point to the side to which those of the sheet's part
/// next to it point: only cracks oriented alike can grow together (find_joint). Across each other, or where
/// the sheet is empty, it stays as it is.
TriMesh oriented_like(const CrackSheet& sheet, TriMesh part);

/// Frames at the nodes of one front of the sheet; as long as it has not grown, with normals carried on to the
/// front.
std::vector<FrontFrame> front_frames(const CrackSheet& sheet, const SheetFront& front);
/// The same with node_area_vectors() of its mesh at hand, for many fronts.
std::vector<FrontFrame> front_frames(const CrackSheet& sheet, const SheetFront& front,
                                     const IdVector<NodeId, Vec3>& area_vectors);

struct FrontMotion {
  NodeId node;        ///< on a front
  Vec3 displacement;  ///< [m]
};

/// Nodes that would come too close to another front, or to another part of their own front, that faces them
/// (their e2 point against each other), on their way or at its end: closer than 0.3 target_edge; where the
/// sheets are oriented alike 1 within one front, and 0.7 between two unless they are more than 0.45 apart
/// across the sheets. Both sides are listed, sorted. Parts of a front fewer than three edges apart do not
/// count.
std::vector<NodeId> touching_nodes(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                   double target_edge);

/// How the nodes of a new front follow from the old ones.
struct FrontSuccession {
  enum class Kind : std::uint8_t { kept, moved, merged, inserted };
  NodeId node;  ///< on the new front
  Kind kind = Kind::kept;
  NodeId first, last;  ///< old nodes, in front order: first = last for kept and moved; the ends of the merged
                       ///< run; the two it is inserted between
  double s = 0;        ///< inserted: fraction between the successors of first and last
};

struct AdvanceResult {
  NodeId first_new_node;  ///< new nodes are first_new_node … end
  TriId first_new_triangle;
  std::vector<std::vector<FrontSuccession>>
      succession;                ///< per front of the sheet as it was before; empty: it has closed
  std::vector<NodeId> arrested;  ///< nodes stopped because they touch; their state is now `arrested`
};

struct AdvanceSettings {
  /// Share of the way to the middle of its neighbours along the front (and a fifth of it across) that a new
  /// node is drawn. 0: none.
  double smoothing = 0.25;
  bool stop_touching = true;         ///< nodes that touch (touching_nodes) are not moved and become arrested
  double split_above = kSplitAbove;  ///< × target_edge
  double collapse_below = kCollapseBelow;  ///< × target_edge
  /// Position of inserted and merged nodes between two old nodes; see StripSettings. Empty: straight.
  std::function<Vec3(NodeId a, NodeId b, double s)> between = {};
};

/// Moves front nodes and appends the strip between the old and the new front (rules: strip.hpp); nodes
/// without a motion stay. A ring that shrinks, all of its nodes moving, until it fits in a circle of radius
/// 0.3 target_edge closes and its front vanishes.
/// @throws InputError  a motion of a node that is on no front, or not finite
AdvanceResult advance(CrackSheet& sheet, const std::vector<FrontMotion>& motions, double target_edge,
                      const AdvanceSettings& settings = {});

}  // namespace conchoid
