#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {

std::vector<EdgeUse> edge_uses(const IdVector<TriId, std::array<NodeId, 3>>& triangles,
                               std::size_t node_count) {
  std::vector<Edge> sides;
  sides.reserve(3 * triangles.size());
  for (const auto& c : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sides.emplace_back(c[k], c[(k + 1) % 3]);
  sort_by_edge(sides, node_count, [](const Edge& e) { return e; });
  std::vector<EdgeUse> uses;
  for (const Edge& e : sides)
    if (!uses.empty() && uses.back().edge == e)
      ++uses.back().count;
    else
      uses.push_back({e, 1});
  return uses;
}

}  // namespace conchoid
