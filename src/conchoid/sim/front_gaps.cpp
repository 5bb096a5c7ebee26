#include "conchoid/sim/front_gaps.hpp"

#include <optional>

namespace conchoid {

std::unordered_map<NodeId, std::size_t> points_by_cut_node(const CrackState& crack) {
  std::unordered_map<NodeId, std::size_t> point_at;
  for (std::size_t i = 0; i < crack.points.size(); ++i)
    point_at[crack.node_in_cut[crack.points[i].node]] = i;
  return point_at;
}

std::vector<PointChain> point_chains(const CrackState& crack) {
  const std::unordered_map<NodeId, std::size_t> point_at = points_by_cut_node(crack);
  std::vector<PointChain> chains;
  for (const Front& front : crack.fronts) {
    PointChain chain{{}, front.closed};
    for (const NodeId node : front.nodes)  // the ends at the body's surface are no points
      if (const auto found = point_at.find(node); found != point_at.end())
        chain.points.push_back(found->second);
    if (!chain.points.empty()) chains.push_back(std::move(chain));
  }
  return chains;
}

namespace {

// The point `step` places along the chain from place `at`; none beyond the end of an open one.
std::optional<std::size_t> neighbour(const PointChain& chain, std::size_t at, std::ptrdiff_t step) {
  const auto n = static_cast<std::ptrdiff_t>(chain.points.size());
  std::ptrdiff_t to = static_cast<std::ptrdiff_t>(at) + step;
  if (chain.closed) to = (to % n + n) % n;
  if (to < 0 || to >= n) return {};
  return chain.points[static_cast<std::size_t>(to)];
}

// One to each side at the least number of steps at which there is one.
std::vector<std::size_t> nearest_on(const PointChain& chain, std::size_t at, const std::vector<char>& known) {
  const auto n = static_cast<std::ptrdiff_t>(chain.points.size());
  std::vector<std::size_t> found;
  for (std::ptrdiff_t step = 1; step < n && found.empty(); ++step)
    for (const std::ptrdiff_t side : {-step, step})
      if (const auto point = neighbour(chain, at, side); point && known[*point]) found.push_back(*point);
  return found;
}

}  // namespace

std::vector<std::vector<std::size_t>> nearest_known(const std::vector<PointChain>& chains,
                                                    const std::vector<char>& known) {
  std::vector<std::vector<std::size_t>> nearest(known.size());
  for (const PointChain& chain : chains)
    for (std::size_t at = 0; at < chain.points.size(); ++at)
      if (!known[chain.points[at]]) nearest[chain.points[at]] = nearest_on(chain, at, known);
  return nearest;
}

void fill_gaps(const std::vector<PointChain>& chains, std::vector<FrontOpening>& openings) {
  std::vector<char> known;
  for (const FrontOpening& opening : openings)
    known.push_back(opening.known);
  const std::vector<std::vector<std::size_t>> nearest = nearest_known(chains, known);
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (nearest[i].empty()) continue;
    Vec3 sum = Vec3::Zero();
    for (const std::size_t point : nearest[i])
      sum += openings[point].intensity;
    openings[i].intensity = openings[i].node_intensity = sum / static_cast<double>(nearest[i].size());
    openings[i].known = true;
  }
}

}  // namespace conchoid
