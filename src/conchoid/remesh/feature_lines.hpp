#pragma once

#include <optional>
#include <set>

#include "conchoid/remesh/editable_mesh.hpp"

namespace conchoid {

/// The sharp edges of a surface that remeshing must keep, and how they change with it.
class FeatureLines {
 public:
  enum class Kind { free, crease, corner };

  /// None.
  FeatureLines() = default;
  /// Edges where the normals differ by more than `angle` [rad], in connected lines whose total length is at
  /// least `shortest_line` [m]. Nodes where lines end, meet or turn by more than `angle` are corners and stay
  /// where they are.
  FeatureLines(const TriMesh& mesh, double angle, double shortest_line);

  const std::set<Edge>& edges() const { return edges_; }
  bool contains(const Edge& e) const { return edges_.contains(e); }
  Kind kind(NodeId n) const;
  /// The nodes before and after a crease node on its line.
  std::array<NodeId, 2> along(NodeId n) const;

  /// Which end of an edge may be merged into the other, and whether that one may move.
  struct Merge {
    NodeId removed, kept;
    bool may_move;
  };
  std::optional<Merge> merge(const Edge& e) const;

  void was_split(const Edge& e, NodeId middle);
  void was_collapsed(NodeId removed, NodeId kept);

 private:
  void insert(const Edge& e);
  void erase(const Edge& e);
  std::vector<NodeId>& lines_at(NodeId n);

  std::set<Edge> edges_;
  IdVector<NodeId, std::vector<NodeId>> at_node_;  ///< the other ends of feature edges
  IdVector<NodeId, Kind> kind_;
};

}  // namespace conchoid
