#include "conchoid/surface/mass_properties.hpp"

#include <cstddef>
#include <vector>

#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {

MassProperties mass_properties(const TriMesh& closed, double density) {
  const Vec3 origin = bounding_box(closed).center();
  double volume = 0;
  Vec3 first = Vec3::Zero();   // ∫ r
  Mat3 second = Mat3::Zero();  // ∫ r rᵀ
  for (const auto& c : closed.corners) {
    const Vec3 u = closed.positions[c[0]] - origin, v = closed.positions[c[1]] - origin,
               w = closed.positions[c[2]] - origin;
    const double six = u.dot(cross(v, w));
    const Vec3 sum = u + v + w;
    volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 * (u * u.transpose() + v * v.transpose() + w * w.transpose() + sum * sum.transpose());
  }
  MassProperties result;
  result.volume = volume;
  result.mass = density * volume;
  result.center_of_mass = origin;
  if (volume > 0) {
    const Vec3 center = first / volume;
    result.center_of_mass += center;
    second -= volume * center * center.transpose();
    result.inertia = density * (second.trace() * Mat3::Identity() - second);
  }
  return result;
}

bool is_watertight(const TriMesh& mesh) {
  struct Side {
    Edge edge;
    bool along;  // from edge.a to edge.b
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (const auto& c : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back({Edge(c[k], c[(k + 1) % 3]), c[k] < c[(k + 1) % 3]});
  sort_by_edge(sides, mesh.node_count(), [](const Side& s) { return s.edge; });
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge)
      ++end;
    const bool back_and_forth = end == i + 2 && sides[i].along != sides[i + 1].along;
    const bool at_one_node = end == i + 1 && sides[i].edge.a == sides[i].edge.b;
    if (!back_and_forth && !at_one_node) return false;
    i = end;
  }
  return true;
}

}  // namespace conchoid
