#include "conchoid/crack/closing/front_joint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "conchoid/crack/closing/bridge_triangulation.hpp"
#include "conchoid/crack/front/front_frames.hpp"

namespace conchoid {

double opening_angle(const CrackSheet& sheet, const SheetFront& front, const FrontFrame& frame,
                     std::size_t i) {
  const std::size_t n = front.nodes.size();
  const std::size_t before = previous_index(i, n, front.closed), after = next_index(i, n, front.closed);
  if (before == i || after == i) return std::numbers::pi;
  const auto& x = sheet.mesh.positions;
  const Vec3 a = (x[front.nodes[before]] - x[front.nodes[i]]).normalized();
  const Vec3 b = (x[front.nodes[after]] - x[front.nodes[i]]).normalized();
  if ((a + b).dot(frame.e2) <= 0) return std::numbers::pi;
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

std::vector<FrontChain> relinked(const std::vector<FrontChain>& chains,
                                 const std::vector<std::size_t>& removed,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& links) {
  std::map<std::size_t, std::size_t> next;
  std::vector<std::size_t> order;
  for (const FrontChain& chain : chains)
    for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
      order.push_back(chain.nodes[i]);
      const std::size_t j = next_index(i, chain.nodes.size(), chain.closed);
      if (j != i) next[chain.nodes[i]] = chain.nodes[j];
    }
  for (const std::size_t x : removed) {
    next.erase(x);
    std::erase(order, x);
    std::erase_if(next, [&](const auto& link) { return link.second == x; });
  }
  for (const auto& [from, to] : links) {
    std::erase_if(next, [&, target = to](const auto& link) { return link.second == target; });
    next[from] = to;
    for (const std::size_t x : {from, to})
      if (std::find(order.begin(), order.end(), x) == order.end()) order.push_back(x);
  }
  std::map<std::size_t, std::size_t> previous;
  for (const auto& [from, to] : next)
    previous[to] = from;
  std::vector<FrontChain> out;
  std::map<std::size_t, bool> done;
  for (const bool closed : {false, true})
    for (const std::size_t start : order) {
      if (done[start] || (!closed && previous.contains(start))) continue;
      FrontChain chain;
      chain.closed = closed;
      for (std::size_t x = start; !done[x];) {
        done[x] = true;
        chain.nodes.push_back(x);
        const auto to = next.find(x);
        if (to == next.end()) break;
        x = to->second;
      }
      if (chain.nodes.size() >= (closed ? 3u : 2u)) out.push_back(std::move(chain));
    }
  return out;
}

JoinedFronts join_fronts(CrackSheet& sheet, const FrontJoint& joint) {
  const IdVector<NodeId, Vec3> normals = unit_node_normals(sheet.mesh);
  for (const auto& t : triangles_between(sheet.mesh.positions, normals, joint.first, joint.second))
    sheet.mesh.corners.push_back(t);
  sheet.triangle_birth.resize(sheet.mesh.triangle_count(), sheet.frame);
  std::vector<FrontChain> chains;
  std::vector<SheetFront> fronts;
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  JoinedFronts joined{none, none};
  for (std::size_t f = 0; f < sheet.fronts.size(); ++f) {
    SheetFront& front = sheet.fronts[f];
    const auto has = [&](NodeId n) {
      return std::find(front.nodes.begin(), front.nodes.end(), n) != front.nodes.end();
    };
    if (has(joint.first[0])) joined.first = f;
    if (has(joint.second[0])) joined.second = f;
    if (joined.first != f && joined.second != f) {
      fronts.push_back(std::move(front));
      continue;
    }
    FrontChain& chain = chains.emplace_back();
    chain.closed = front.closed;
    for (const NodeId n : front.nodes)
      chain.nodes.push_back(n.index());
  }
  std::vector<std::size_t> removed;
  std::vector<std::pair<std::size_t, std::size_t>> links;
  for (const auto* run : {&joint.first, &joint.second})
    for (std::size_t k = 1; k + 1 < run->size(); ++k)
      removed.push_back((*run)[k].index());
  const auto meet = [&](NodeId from, NodeId to) {
    if (from == to)
      removed.push_back(from.index());
    else
      links.emplace_back(from.index(), to.index());
  };
  meet(joint.first.front(), joint.second.back());
  meet(joint.second.front(), joint.first.back());
  for (const FrontChain& chain : relinked(chains, removed, links)) {
    SheetFront& front = fronts.emplace_back();
    front.closed = chain.closed;
    for (const std::size_t x : chain.nodes)
      front.nodes.push_back(NodeId(x));
    if (front.closed) start_at_smallest_id(front.nodes);
  }
  sheet.fronts = std::move(fronts);
  return joined;
}

}  // namespace conchoid
