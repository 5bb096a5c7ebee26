#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "conchoid/core/cells.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A closed surface that is changed by local steps. Every step checks first that the surface stays closed and
/// manifold, that no triangle turns over (its normal by more than about 70°) or collapses, and that it does
/// not intersect the rest; otherwise the step is refused and nothing changes. Before a step requests to stop are
/// heard (Interrupted). Ids of removed triangles and
/// nodes are not used again.
class EditableMesh {
 public:
  /// `cell`: edge of the grid cells that find triangles near a place; about the edge length aimed at [m].
  EditableMesh(const TriMesh& mesh, double cell);

  std::size_t triangle_count() const { return alive_count_; }
  /// Ids below these have been given out.
  std::size_t node_slots() const { return positions_.size(); }
  std::size_t triangle_slots() const { return corners_.size(); }

  bool alive(NodeId n) const { return !stars_[n].empty(); }
  bool alive(TriId t) const { return corners_[t][0].valid(); }
  const Vec3& position(NodeId n) const { return positions_[n]; }
  const std::array<NodeId, 3>& corners(TriId t) const { return corners_[t]; }
  Triangle triangle(TriId t) const;
  /// Triangles around a node.
  const std::vector<TriId>& star(NodeId n) const { return stars_[n]; }
  /// Nodes joined to n by an edge, ascending.
  std::vector<NodeId> neighbours(NodeId n) const;
  bool has_edge(NodeId a, NodeId b) const;
  /// All edges, ascending.
  std::vector<Edge> edges() const;
  double length(const Edge& e) const { return (positions_[e.a] - positions_[e.b]).norm(); }

  /// The two triangles at an edge; the first runs through it from e.a to e.b.
  std::array<TriId, 2> triangles_at(const Edge& e) const;
  /// The corner of a triangle that is not on its edge e.
  NodeId opposite(TriId t, const Edge& e) const;

  // The steps. All return whether (or with what) they were done.
  NodeId split(const Edge& e, const Vec3& at);
  bool collapse(NodeId removed, NodeId kept, const Vec3& at);
  bool flip(const Edge& e);
  bool move(NodeId n, const Vec3& to);

  /// The surface as it is now, nodes and triangles numbered anew in the order of their ids.
  TriMesh compact() const;

 private:
  struct Change {
    std::vector<TriId> removed;
    std::vector<std::array<NodeId, 3>> added;
    std::vector<Vec3> references;  ///< per added triangle: the normal it should roughly have, any length
    NodeId moved;                  ///< invalid: none
    Vec3 at = Vec3::Zero();
  };

  bool apply(const Change& change);
  bool acceptable(const Change& change);
  bool keeps_clear(const std::vector<std::array<NodeId, 3>>& added, const std::vector<TriId>& removed);
  void remove(TriId t);
  TriId add(const std::array<NodeId, 3>& corners);
  /// Calls visit(cell) for the cells of the grid that a box meets.
  template <class Visit>
  void visit_cells(const Box& box, const Visit& visit) const;
  Triangle triangle(const std::array<NodeId, 3>& corners) const;

  IdVector<NodeId, Vec3> positions_;
  IdVector<TriId, std::array<NodeId, 3>> corners_;
  IdVector<NodeId, std::vector<TriId>> stars_;
  std::size_t alive_count_ = 0;

  double cell_;
  Vec3 origin_;
  std::unordered_map<Cell, std::vector<TriId>, CellHash> grid_;
  IdVector<TriId, std::uint32_t> visited_;  ///< query in which a triangle was last looked at
  std::uint32_t query_ = 0;
};

/// Height over longest edge, √3/2 for the equilateral triangle.
double flatness(const Triangle& triangle);
/// Smallest angle [rad].
double smallest_angle(const Triangle& triangle);

}  // namespace conchoid
