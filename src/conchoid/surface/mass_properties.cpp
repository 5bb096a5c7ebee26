#include "conchoid/surface/mass_properties.hpp"

#include <algorithm>

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
  std::vector<std::pair<NodeId, NodeId>> forth, back;
  for (const auto& c : mesh.corners)
    for (int k = 0; k < 3; ++k) {
      forth.emplace_back(c[k], c[(k + 1) % 3]);
      back.emplace_back(c[(k + 1) % 3], c[k]);
    }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back && std::adjacent_find(forth.begin(), forth.end()) == forth.end();
}

}  // namespace conchoid
