#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/corners.hpp"

namespace conchoid {

struct CutPiece {
  Corners corners;
  TriId parent;
  bool has(NodeId n) const { return conchoid::has(corners, n); }
};

/// Pieces of the surface or of the sheet, with the pieces around each node.
class CutLayer {
 public:
  CutLayer(const IdVector<TriId, std::array<NodeId, 3>>& corners, const std::vector<TriId>& parents,
           std::size_t node_count)
      : around_(node_count) {
    for (std::size_t p = 0; p < corners.size(); ++p)
      add({corners[TriId(p)], parents[p]});
  }
  void add(const CutPiece& piece) {
    for (const NodeId n : piece.corners)
      around_[n].push_back(pieces_.size());
    pieces_.push_back(piece);
    alive_.push_back(true);
  }
  void remove(std::size_t p) {
    alive_[p] = false;
    for (const NodeId n : pieces_[p].corners)
      std::erase(around_[n], p);
  }
  const std::vector<std::size_t>& around(NodeId n) const { return around_[n]; }
  const CutPiece& operator[](std::size_t p) const { return pieces_[p]; }
  bool alive(std::size_t p) const { return alive_[p]; }
  std::size_t size() const { return pieces_.size(); }
  /// Pieces that have the edge.
  std::vector<std::size_t> on_edge(NodeId a, NodeId b) const {
    std::vector<std::size_t> found;
    for (const std::size_t p : around_[a])
      if (pieces_[p].has(b)) found.push_back(p);
    return found;
  }

 private:
  std::vector<CutPiece> pieces_;
  std::vector<bool> alive_;
  IdVector<NodeId, std::vector<std::size_t>> around_;
};

/// A change of the complex, to be checked before it is made.
struct CutChange {
  NodeId moved;  ///< invalid: no node moves
  Vec3 to = Vec3::Zero();
  std::vector<NodeId> gone;                         ///< nodes that disappear
  std::array<std::vector<std::size_t>, 2> removed;  ///< per layer
  std::array<std::vector<CutPiece>, 2> added;
  std::vector<Edge> mouth_removed, mouth_added;
};

/// A cut complex that can be changed piece by piece, and stays valid: every change is checked before it is
/// made.
class CutEditor {
 public:
  static constexpr int surface_layer = 0, sheet_layer = 1;

  CutEditor(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet);

  bool on_surface(NodeId n) const { return !layers_[surface_layer].around(n).empty(); }
  bool on_mouth(NodeId n) const { return !mouth_[n].empty(); }
  bool is_mouth(NodeId a, NodeId b) const {
    return std::find(mouth_[a].begin(), mouth_[a].end(), b) != mouth_[a].end();
  }
  const Vec3& at(NodeId n) const { return cut_.positions[n]; }

  /// Makes the change if the complex stays valid (surface closed and manifold, sheet manifold, no piece
  /// turned over or laid into the surface, mouth a curve) and the worst piece around gets better; false, and
  /// nothing happens, otherwise.
  bool make(const CutChange& change);
  /// Writes the pieces back, numbered without gaps, in an order that does not tell how they came about.
  void write_back();

 protected:
  CutComplex& cut_;
  const TriMesh& surface_;
  const TriMesh& sheet_;
  std::array<CutLayer, 2> layers_;
  IdVector<NodeId, std::vector<NodeId>> mouth_;  ///< neighbours along the mouth

 private:
  const Vec3& at_after(NodeId n, const CutChange& change) const {
    return n == change.moved ? change.to : at(n);
  }
  bool improves_shape(const CutChange& change) const;
  bool stays_valid(const CutChange& change) const;
  bool lies_in_surface(const Corners& sheet_piece, const CutChange& change) const;
  bool node_valid(NodeId n, const CutChange& change) const;
  double quality(const std::array<NodeId, 3>& c, const CutChange& change, const Vec3& normal,
                 bool after) const;
  std::vector<std::array<NodeId, 3>> around_after(int l, NodeId n, const CutChange& change) const;
  bool is_mouth_after(NodeId a, NodeId b, const CutChange& change) const;
  void apply(const CutChange& change);
  void write_layer(int l, const IdVector<NodeId, NodeId>& renumbered,
                   IdVector<TriId, std::array<NodeId, 3>>& corners, std::vector<TriId>& parents) const;
};

}  // namespace conchoid
