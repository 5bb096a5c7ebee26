#include "conchoid/intersect/manifold_part.hpp"

#include <algorithm>
#include <limits>
#include <unordered_set>

#include "conchoid/intersect/self_intersection.hpp"

namespace conchoid {
namespace {

std::uint64_t directed(NodeId a, NodeId b) {
  return static_cast<std::uint64_t>(a.index()) << 32 | static_cast<std::uint64_t>(b.index());
}

}  // namespace

TriMesh manifold_part(const TriMesh& sheet) {
  TriMesh out;
  out.positions = sheet.positions;
  std::unordered_set<std::uint64_t> taken;
  taken.reserve(3 * sheet.triangle_count());
  for (const auto& c : sheet.corners) {
    const auto edge = [&](int k) { return directed(c[k], c[(k + 1) % 3]); };
    if (taken.contains(edge(0)) || taken.contains(edge(1)) || taken.contains(edge(2))) continue;
    for (int k = 0; k < 3; ++k)
      taken.insert(edge(k));
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
