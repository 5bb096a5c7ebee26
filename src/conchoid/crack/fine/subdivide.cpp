#include "conchoid/crack/fine/subdivide.hpp"

#include <algorithm>

namespace conchoid {

Subdivision::Subdivision(const TriMesh& coarse, std::size_t first, int parts, TriMesh& fine)
    : parts_(parts), corner_(coarse.node_count()) {
  for (std::size_t t = first; t < coarse.triangle_count(); ++t) {
    const auto& c = coarse.corners[TriId(t)];
    for (int k = 0; k < 3; ++k) {
      edges_.emplace_back(c[k], c[(k + 1) % 3]);
      corner_[c[k].index()] = NodeId(0);  // used
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  for (std::size_t i = 0; i < corner_.size(); ++i)
    if (corner_[i].valid()) corner_[i] = fine.positions.add(coarse.positions[NodeId(i)]);
  for (const Edge& edge : edges_) {
    edge_first_.push_back(NodeId(fine.node_count()));
    for (int k = 1; k < parts; ++k) {
      const double s = static_cast<double>(k) / parts;
      fine.positions.push_back((1 - s) * coarse.positions[edge.a] + s * coarse.positions[edge.b]);
    }
  }
  for (std::size_t t = first; t < coarse.triangle_count(); ++t)
    append_triangle(coarse, TriId(t), fine);
}

NodeId Subdivision::edge_node(NodeId a, NodeId b, int k) const {
  if (k == 0) return corner(a);
  if (k == parts_) return corner(b);
  const auto at = std::lower_bound(edges_.begin(), edges_.end(), Edge(a, b)) - edges_.begin();
  const int from_smaller = a < b ? k : parts_ - k;
  return NodeId(edge_first_[static_cast<std::size_t>(at)].index() + static_cast<std::size_t>(from_smaller) -
                1);
}

std::vector<NodeId> Subdivision::along(NodeId a, NodeId b) const {
  std::vector<NodeId> nodes;
  for (int k = 0; k < parts_; ++k)
    nodes.push_back(edge_node(a, b, k));
  return nodes;
}

/// Rows of nodes from the corner with the smallest id (row 0) to the opposite edge (row `parts`), each
/// towards the largest id: the numbering does not depend on which side the triangle is seen from.
void Subdivision::append_triangle(const TriMesh& coarse, TriId t, TriMesh& fine) const {
  std::array<NodeId, 3> turned = coarse.corners[t];
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  const bool flipped = turned[2] < turned[1];
  const NodeId a = turned[0], b = std::min(turned[1], turned[2]), c = std::max(turned[1], turned[2]);
  std::vector<std::vector<NodeId>> rows;
  for (int i = 0; i <= parts_; ++i) {
    std::vector<NodeId>& row = rows.emplace_back();
    for (int j = 0; j <= i; ++j) {
      if (j == 0)
        row.push_back(edge_node(a, b, i));
      else if (j == i)
        row.push_back(edge_node(a, c, i));
      else if (i == parts_)
        row.push_back(edge_node(b, c, j));
      else
        row.push_back(fine.positions.add(
            ((parts_ - i) * coarse.positions[a] + (i - j) * coarse.positions[b] + j * coarse.positions[c]) /
            parts_));
    }
  }
  const auto add = [&](NodeId x, NodeId y, NodeId z) {
    fine.corners.push_back(flipped ? std::array{x, z, y} : std::array{x, y, z});
  };
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      add(rows[i][j], rows[i + 1][j], rows[i + 1][j + 1]);
      if (j < i) add(rows[i][j], rows[i + 1][j + 1], rows[i][j + 1]);
    }
}

}  // namespace conchoid
