#include "conchoid/sim/front_pasts.hpp"

#include <algorithm>

namespace conchoid {
namespace {

std::vector<NodeId> nearest_in_space(const CrackState& crack, const FrontHistory& history, const Vec3& x) {
  const auto& positions = crack.sheet.mesh.positions;
  const std::vector<NodeId>& last = history.last();
  const auto nearest = std::min_element(last.begin(), last.end(), [&](NodeId a, NodeId b) {
    return (positions[a] - x).squaredNorm() < (positions[b] - x).squaredNorm();
  });
  return nearest == last.end() ? std::vector<NodeId>() : std::vector<NodeId>{*nearest};
}

}  // namespace

std::vector<FrontPast> front_pasts(const CrackState& crack, const FrontHistory& history) {
  std::vector<FrontPast> pasts(crack.points.size());
  std::vector<char> known;
  for (std::size_t i = 0; i < pasts.size(); ++i) {
    const NodeId old = crack.points[i].correlation;
    pasts[i].own = history.sample(crack, crack.points[i], old).has_value();
    known.push_back(pasts[i].own &&
                    history.find(crack.points[i].node) == nullptr);  // what stays comes from farther back
    if (pasts[i].own) pasts[i].nodes = {old};
  }
  const std::vector<PointChain> chains = point_chains(crack);
  const std::vector<std::vector<std::size_t>> nearest = nearest_known(chains, known);
  for (const PointChain& chain : chains)
    for (const std::size_t i : chain.points) {
      if (pasts[i].own) continue;
      for (const std::size_t neighbour : nearest[i])
        pasts[i].nodes.push_back(crack.points[neighbour].correlation);
      const NodeId node = crack.points[i].node;
      if (pasts[i].nodes.empty() && history.find(node) == nullptr)
        pasts[i].nodes = nearest_in_space(crack, history, crack.sheet.mesh.positions[node]);
    }
  return pasts;
}

}  // namespace conchoid
