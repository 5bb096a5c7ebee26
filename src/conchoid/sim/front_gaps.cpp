#include "conchoid/sim/front_gaps.hpp"

#include <algorithm>
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

std::vector<std::optional<std::size_t>> nearest_before_ends(const std::vector<PointChain>& chains,
                                                            const std::vector<char>& known) {
  std::vector<std::optional<std::size_t>> nearest(known.size());
  for (const PointChain& chain : chains) {
    const auto& points = chain.points;
    const auto has = [&](std::size_t point) { return known[point] != 0; };
    const auto first = std::find_if(points.begin(), points.end(), has);
    if (chain.closed || first == points.end()) continue;
    const auto behind_last = std::find_if(points.rbegin(), points.rend(), has).base();
    std::for_each(points.begin(), first, [&](std::size_t point) { nearest[point] = *first; });
    std::for_each(behind_last, points.end(), [&](std::size_t point) { nearest[point] = *(behind_last - 1); });
  }
  return nearest;
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

// Mean K of the nearest points of the chain that have one.
std::optional<Vec3> nearest_intensity(const PointChain& chain, std::size_t at, const std::vector<char>& known,
                                      const std::vector<FrontOpening>& openings) {
  const auto n = static_cast<std::ptrdiff_t>(chain.points.size());
  for (std::ptrdiff_t step = 1; step < n; ++step) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const std::ptrdiff_t side : {step, -step})
      if (const auto point = neighbour(chain, at, side); point && known[*point]) {
        sum += openings[*point].intensity;
        ++count;
      }
    if (count > 0) return sum / count;
  }
  return {};
}

}  // namespace

void fill_gaps(const std::vector<PointChain>& chains, std::vector<FrontOpening>& openings) {
  std::vector<char> known;
  for (const FrontOpening& opening : openings)
    known.push_back(opening.known);
  for (const PointChain& chain : chains)
    for (std::size_t at = 0; at < chain.points.size(); ++at) {
      FrontOpening& opening = openings[chain.points[at]];
      if (known[chain.points[at]]) continue;
      if (const auto intensity = nearest_intensity(chain, at, known, openings)) {
        opening.intensity = opening.node_intensity = *intensity;
        opening.known = true;
      }
    }
}

}  // namespace conchoid
