#include "conchoid/bem/node_groups.hpp"

#include <algorithm>

namespace conchoid {
namespace {

using Nodes = std::vector<NodeId>;

void halve(const IdVector<NodeId, Vec3>& positions, Nodes::iterator begin, Nodes::iterator end,
           std::size_t most, std::vector<Nodes>& groups) {
  if (static_cast<std::size_t>(end - begin) <= most) {
    if (begin == end) return;
    std::sort(begin, end);
    groups.emplace_back(begin, end);
    return;
  }
  Vec3 low = positions[*begin], high = low;
  for (auto i = begin; i != end; ++i) {
    low = low.cwiseMin(positions[*i]);
    high = high.cwiseMax(positions[*i]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](NodeId a, NodeId b) {
    const double x = positions[a][axis], y = positions[b][axis];
    return x != y ? x < y : a < b;
  });
  halve(positions, begin, middle, most, groups);
  halve(positions, middle, end, most, groups);
}

}  // namespace

std::vector<std::vector<NodeId>> compact_groups(const IdVector<NodeId, Vec3>& positions,
                                                std::vector<NodeId> nodes, std::size_t most) {
  std::vector<Nodes> groups;
  halve(positions, nodes.begin(), nodes.end(), std::max<std::size_t>(most, 1), groups);
  return groups;
}

}  // namespace conchoid
