#include "conchoid/remesh/edge_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "conchoid/core/interrupt.hpp"

namespace conchoid {

std::vector<EdgeSide> sides_by_edge(const TriMesh& mesh) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId p = mesh.corners[TriId(t)][k], q = mesh.corners[TriId(t)][(k + 1) % 3];
      sides.push_back({Edge(p, q), TriId(t), p < q});
    }
  std::stable_sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    throw_if_interrupted();
    return a.edge < b.edge;
  });
  return sides;
}

std::vector<EdgeSide> around_edge(const TriMesh& mesh, std::vector<EdgeSide> sides) {
  if (sides.size() < 2) return sides;
  const Edge edge = sides.front().edge;
  const Vec3& a = mesh.positions[edge.a];
  const Vec3 axis = (mesh.positions[edge.b] - a).normalized();
  const auto arm = [&](const EdgeSide& side) {
    Vec3 x = Vec3::Zero();
    for (const NodeId n : mesh.corners[side.triangle])
      if (n != edge.a && n != edge.b) x = mesh.positions[n] - a;
    return Vec3(x - x.dot(axis) * axis);
  };
  const Vec3 u = arm(sides.front()).normalized(), v = cross(axis, u);
  std::vector<std::pair<double, EdgeSide>> by_angle;
  for (const EdgeSide& side : sides) {
    const Vec3 x = arm(side);
    double angle = std::atan2(x.dot(v), x.dot(u));
    if (angle < 0 && by_angle.size() > 0) angle += 2 * std::numbers::pi;
    by_angle.emplace_back(by_angle.empty() ? 0 : angle, side);
  }
  std::stable_sort(by_angle.begin(), by_angle.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  for (std::size_t i = 0; i < sides.size(); ++i)
    sides[i] = by_angle[i].second;
  return sides;
}

}  // namespace conchoid
