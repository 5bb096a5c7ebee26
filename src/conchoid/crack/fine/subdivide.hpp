#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Triangles of a mesh, each divided into parts² equal ones, appended to another mesh.
class Subdivision {
 public:
  /// Appends triangles [first, end) of `coarse`, edges in `parts` ≥ 1, to `fine`. Orientation kept.
  Subdivision(const TriMesh& coarse, std::size_t first, int parts, TriMesh& fine);

  /// Fine nodes from a towards b along a coarse edge, a included, b left out.
  std::vector<NodeId> along(NodeId a, NodeId b) const;
  NodeId corner(NodeId coarse) const { return corner_[coarse.index()]; }

 private:
  NodeId edge_node(NodeId a, NodeId b, int k) const;
  void append_triangle(const TriMesh& coarse, TriId t, TriMesh& fine) const;

  int parts_;
  std::vector<NodeId> corner_;  ///< per coarse node
  std::vector<Edge> edges_;     ///< sorted
  std::vector<NodeId>
      edge_first_;  ///< first of the parts − 1 inner nodes of each edge, from the smaller id to the larger
};

}  // namespace conchoid
