#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "conchoid/intersect/inside_pieces.hpp"
#include "conchoid/intersect/predicates.hpp"
#include "conchoid/intersect/retriangulate.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Where an edge of one mesh passes through a triangle of the other: a node of the mouth.
struct MouthNode {
  enum Kind : std::uint8_t { sheet_edge, surface_edge } kind;
  Edge edge;
  TriId triangle;
  friend auto operator<=>(const MouthNode&, const MouthNode&) = default;
};

/// The curves in which a sheet passes through the surface of a body, both in general position (predicates.hpp): where they
/// have nodes, and what they cut each triangle into. Numbers of nodes: the surface's, the sheet's, those of the mouth
/// in their order, and where a sheet or a surface that passes through itself makes curves cross.
/// Throws ComputationError where triangles do not intersect in a segment.
class MouthCurve {
 public:
  /// Of whose edges, and so of whose triangles, too.
  using Kind = MouthNode::Kind;

  /// Both meshes must outlive it.
  MouthCurve(const TriMesh& surface, const TriMesh& sheet);

  const TriMesh& mesh_of(Kind kind) const { return kind == Kind::surface_edge ? surface_ : sheet_; }
  /// Only of what lies near the other mesh, as all triangles at its nodes do.
  PerturbedTriangle surface_triangle(TriId t) const { return surface_points_.triangle(surface_.corners[t]); }
  PerturbedTriangle sheet_triangle(TriId s) const { return sheet_points_.triangle(sheet_.corners[s]); }
  const PerturbedPoint& sheet_point(NodeId n) const { return sheet_points_[n]; }

  const IdVector<NodeId, Vec3>& positions() const { return positions_; }
  /// All nodes but crossings, ascending.
  const std::vector<MouthNode>& nodes() const { return nodes_; }
  /// The number of a node of the mouth; past the last one, of the first crossing.
  NodeId node(std::size_t i) const { return NodeId(surface_.node_count() + sheet_.node_count() + i); }

  /// The triangles through which a curve runs, ascending.
  const std::vector<TriId>& cut_triangles(Kind kind) const { return segments_in(kind).triangles; }
  /// What cuts one triangle. Edges of the surface are cut by the sheet (kind surface_edge) and the other way
  /// round.
  TriangleCut triangle_cut(Kind kind, TriId t) const;
  /// All edges.
  std::vector<MouthSide> sides() const;

 private:
  /// A piece of the mouth: where one surface triangle and one sheet triangle intersect. Inside lies to the left
  /// of from → to, seen from the side the sheet's normal points to.
  struct Segment {
    TriId surface, sheet;
    MouthNode from, to;
    std::vector<NodeId>
        path;  ///< from, crossings with other segments (only if the sheet or the surface passes
               ///< through itself), to
    bool has_step(const Edge& e) const;
  };
  struct Intersection;
  using NearTriangles =
      std::vector<std::pair<TriId, TriId>>;  ///< of surface and sheet, boxes of which overlap
  /// Of the triangles that have some.
  struct SegmentsOfTriangles {
    std::vector<TriId> triangles;                    ///< ascending
    std::vector<std::vector<std::size_t>> segments;  ///< of each of these
    const std::vector<std::size_t>& operator[](TriId t) const;
  };

  MouthCurve(const TriMesh& surface, const TriMesh& sheet, const NearTriangles& near);
  void find_segments(const NearTriangles& near);
  Intersection intersect(TriId t, TriId s) const;
  void make_nodes();
  void order_along_edges();
  bool before(std::size_t i, std::size_t j) const;
  void join_crossings(Kind kind);
  void join(Segment& s, Segment& t);

  const SegmentsOfTriangles& segments_in(Kind kind) const {
    return kind == Kind::surface_edge ? on_surface_ : on_sheet_;
  }
  PerturbedTriangle edge_triangle(const MouthNode& at) const;
  const PerturbedPoints& edge_points(const MouthNode& at) const;
  std::size_t index_of(const MouthNode& at) const;
  std::vector<NodeId> nodes_on_edge(Kind kind, NodeId from, NodeId to) const;
  int turn(Kind kind, TriId t, NodeId before, NodeId at, NodeId after) const;

  const TriMesh& surface_;
  const TriMesh& sheet_;
  PerturbedPoints surface_points_, sheet_points_;  ///< of what is near
  std::vector<Segment> segments_;
  std::vector<MouthNode> nodes_;
  std::vector<Crossing> crossings_;  ///< per node
  std::vector<std::size_t> along_edge_;
  SegmentsOfTriangles on_surface_, on_sheet_;
  IdVector<NodeId, Vec3> positions_;
};

}  // namespace conchoid
