#include "conchoid/intersect/manifold_part.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "conchoid/intersect/self_intersection.hpp"

namespace conchoid {
namespace {

/// Directed edges that triangles have taken, in lists by the node they leave.
class TakenEdges {
 public:
  explicit TakenEdges(const TriMesh& sheet) : begin_(sheet.node_count() + 1, 0), end_(sheet.node_count(), 0) {
    for (const auto& c : sheet.corners)
      for (const NodeId n : c)
        ++begin_[n.index() + 1];
    for (std::size_t n = 0; n < end_.size(); ++n)
      begin_[n + 1] += begin_[n];
    std::copy(begin_.begin(), begin_.end() - 1, end_.begin());
    to_.resize(begin_.back());
  }
  bool contains(NodeId from, NodeId to) const {
    const auto *first = to_.data() + begin_[from.index()], *last = to_.data() + end_[from.index()];
    return std::find(first, last, to) != last;
  }
  void take(NodeId from, NodeId to) { to_[end_[from.index()]++] = to; }

 private:
  std::vector<std::uint32_t> begin_, end_;
  std::vector<NodeId> to_;
};

}  // namespace

TriMesh manifold_part(const TriMesh& sheet) {
  TriMesh out;
  out.positions = sheet.positions;
  out.corners.reserve(sheet.triangle_count());
  TakenEdges taken(sheet);
  for (const auto& c : sheet.corners) {
    if (taken.contains(c[0], c[1]) || taken.contains(c[1], c[2]) || taken.contains(c[2], c[0])) continue;
    for (std::size_t k = 0; k < 3; ++k)
      taken.take(c[k], c[(k + 1) % 3]);
    out.corners.push_back(c);
  }
  return out;
}

TriMesh embedded_part(const TriMesh& sheet) {
  TriMesh part = manifold_part(sheet);
  std::erase_if(part.corners, [&](const auto& c) {
    return area_vector2(part.positions[c[0]], part.positions[c[1]], part.positions[c[2]]).isZero(0);
  });
  auto pairs = self_intersections(part, std::numeric_limits<std::size_t>::max());
  if (pairs.empty()) return part;
  std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
    return x.second != y.second ? x.second < y.second : x.first < y.first;
  });
  std::vector<char> dropped(part.triangle_count(), 0);
  for (const auto& [first, later] : pairs)
    if (!dropped[first.index()]) dropped[later.index()] = 1;
  IdVector<TriId, std::array<NodeId, 3>> kept;
  for (std::size_t t = 0; t < part.triangle_count(); ++t)
    if (!dropped[t]) kept.push_back(part.corners[TriId(t)]);
  part.corners = std::move(kept);
  return part;
}

}  // namespace conchoid
