#include "conchoid/mesh/manifold_part.hpp"

#include <algorithm>
#include <unordered_set>

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

}  // namespace conchoid
