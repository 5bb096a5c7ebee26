#include "conchoid/sim/clamp_edges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {

std::vector<ClampEdge> clamp_edges(const PreparedBody& body) {
  constexpr double smooth = 0.7;  // cosine between the normals
  std::vector<ClampEdge> edges;
  if (body.infinite()) return edges;
  const std::vector<BoundaryKind>& kinds = body.elastic->kinds();
  const auto neighbours = triangle_neighbours(body.surface);
  for (std::size_t t = 0; t < kinds.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const TriId other = neighbours[TriId(t)][k];
      if (!other.valid()) continue;
      const BoundaryKind &here = kinds[t], &there = kinds[other.index()];
      if (here == there || here.held().trace() < there.held().trace()) continue;
      if (here.held().trace() == there.held().trace() && other.index() < t) continue;  // once
      const bool flat = unit_normal(body.surface, TriId(t)).dot(unit_normal(body.surface, other)) > smooth;
      if (!here.holds_all() && !flat) continue;
      const auto& c = body.surface.corners[TriId(t)];
      edges.push_back({body.surface.positions[c[k]], body.surface.positions[c[(k + 1) % 3]], TriId(t)});
    }
  return edges;
}

std::optional<std::string> clamp_near(const PreparedBody& body, const Vec3& x) {
  std::optional<TriId> support;
  double least = 1;  // × what counts as near
  for (const ClampEdge& e : clamp_edges(body)) {
    const double distance = (closest_point_on_triangle({e.a, e.b, e.b}, x) - x).norm();
    const double share = distance / std::max(body.crack_edge, (e.b - e.a).norm());
    if (share >= least) continue;
    least = share;
    support = e.support;
  }
  if (!support) return std::nullopt;
  const int region = region_of_triangles(body.surface, body.regions)[*support];
  return region < 0 ? std::string() : body.regions[static_cast<std::size_t>(region)].name;
}

std::optional<std::string> clamp_warning(const PreparedBody& body, const Vec3& x) {
  const auto region = clamp_near(body, x);
  if (!region) return std::nullopt;
  const Vec3 at = x + body.origin;
  return fmt::format(
      "the crack at ({:.4g}, {:.4g}, {:.4g}) starts at the edge of the support '{}', where the stress grows "
      "without bound as elements get smaller: where and under which load it starts says nothing about the "
      "strength; let components of the displacement free there, hold the body farther from where it breaks, "
      "or "
      "keep cracks away with [[region]] initiation = false",
      at[0], at[1], at[2], *region);
}

}  // namespace conchoid
