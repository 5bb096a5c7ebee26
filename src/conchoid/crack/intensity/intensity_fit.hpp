#pragma once

#include <vector>

#include "conchoid/crack/front/front.hpp"

namespace conchoid {

/// Nodes joined by an edge to each node, ascending, as one flat array.
class NodeLinks {
 public:
  explicit NodeLinks(const TriMesh& mesh);
  const NodeId* begin(NodeId n) const { return targets_.data() + first_[n.index()]; }
  const NodeId* end(NodeId n) const { return targets_.data() + first_[n.index() + 1]; }

 private:
  std::vector<std::size_t> first_;
  std::vector<NodeId> targets_;
};

/// True for nodes of boundary edges.
std::vector<bool> boundary_marks(const TriMesh& crack);

/// True for nodes that no √r law behind `front` applies to: its own nodes, and nodes of other fronts
/// (boundary nodes that do not open).
/// @param boundary  boundary_marks()
std::vector<bool> front_marks(const std::vector<bool>& boundary, const Front& front,
                              const IdVector<NodeId, Vec3>& opening);

/// Row of each node behind the front: 1 for a node joined to a node of the front by an edge, 2 for the next
/// row … 0 for marked nodes and nodes farther than the rows searched.
std::vector<int> rows_behind(const TriMesh& crack, const NodeLinks& links, const Front& front,
                             const std::vector<bool>& on_front);

/// One opening sample behind a front node; lengths divided by the local front edge length h.
struct OpeningSample {
  int row = 1;               ///< row of nodes it belongs to
  bool mouth = false;        ///< of a node at the mouth of the crack
  double r = 0;              ///< distance from the front / h
  double s = 0;              ///< position of the foot along the front / h, 0 at the front node
  double turn = 0;           ///< of the sheet between front and node [rad]; see KinkBehind
  double kink = 0;           ///< at the node [rad]
  Vec3 rate = Vec3::Zero();  ///< Δu/√r in the frame at the foot [√m]
};

struct KinkBehind;

/// What lies behind a front; per node of the crack.
struct SheetBehind {
  NodeLinks links;
  std::vector<int> rows;          ///< rows_behind()
  std::vector<KinkBehind> kinks;  ///< kinks_behind()
  std::vector<bool> mouth;        ///< on an edge of the crack that is no front
};

/// Samples around node i of the front, nearest rows first found through the mesh: |s| ≤ 1.6 h, r ≤ 3.6 h. Those
/// at a kink of the sheet as a straight crack has them.
std::vector<OpeningSample> gather_samples(const TriMesh& crack, const Front& front, std::size_t i,
                                          const SheetBehind& behind, const IdVector<NodeId, Vec3>& opening,
                                          bool galerkin_openings);

/// Fits rate(r, s) = A + A' s + A" s² + B r by weighted least squares and returns A in `rate`; false without
/// a sample. Samples behind a kink are left out, unless hardly any other is there.
bool fit_rate(const std::vector<OpeningSample>& samples, bool galerkin_openings, Vec3& rate);

}  // namespace conchoid
