#include "conchoid/sim/front_pasts.hpp"

#include <algorithm>
#include <map>

namespace conchoid {
namespace {

// Per correlation node the nearest point of its front.
std::map<NodeId, std::size_t> nearest_points(const CrackState& crack) {
  std::map<NodeId, std::size_t> nearest;
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    if (!point.correlation.valid() || !(point.distance > 0)) continue;
    const auto [entry, is_new] = nearest.try_emplace(point.correlation, i);
    if (!is_new && point.distance < crack.points[entry->second].distance) entry->second = i;
  }
  return nearest;
}

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
  const std::map<NodeId, std::size_t> nearest_to = nearest_points(crack);
  std::vector<char> known;
  for (std::size_t i = 0; i < pasts.size(); ++i) {
    const NodeId old = crack.points[i].correlation;
    pasts[i].correlation = history.knows(crack.points[i], old);
    pasts[i].own = pasts[i].correlation && nearest_to.at(old) == i;
    if (pasts[i].correlation) pasts[i].nodes = {old};
    known.push_back(pasts[i].correlation &&
                    history.find(crack.points[i].node) == nullptr);  // what stays comes from farther back
  }
  const std::vector<PointChain> chains = point_chains(crack);
  const std::vector<std::vector<std::size_t>> nearest = nearest_known(chains, known);
  for (const PointChain& chain : chains)
    for (const std::size_t i : chain.points) {
      if (pasts[i].correlation) continue;
      for (const std::size_t neighbour : nearest[i])
        pasts[i].nodes.push_back(crack.points[neighbour].correlation);
      const NodeId node = crack.points[i].node;
      if (pasts[i].nodes.empty() && history.find(node) == nullptr)
        pasts[i].nodes = nearest_in_space(crack, history, crack.sheet.mesh.positions[node]);
    }
  return pasts;
}

}  // namespace conchoid
