#include "conchoid/mesh/bores.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "conchoid/core/union_find.hpp"

namespace conchoid {
namespace {

constexpr double least_turn = 0.05;   // rad between the normals of two triangles: less is flat
constexpr double largest_turn = 1.1;  // rad: more is an edge
constexpr std::size_t fewest = 6;
constexpr double balance = 0.1;      // × area: sum of the area vectors of what closes around a middle
constexpr double pointing_in = 0.9;  // of the area

/// Angle between the normals of two triangles [rad], above 0 where the surface bends inward.
double inward_turn(const TriMesh& mesh, TriId s, TriId t) {
  const Vec3 a = unit_normal(mesh, s), b = unit_normal(mesh, t);
  const double angle = std::atan2(cross(a, b).norm(), a.dot(b));
  return a.dot(centroid(mesh, t) - centroid(mesh, s)) > 0 ? angle : -angle;
}

}  // namespace

std::vector<Bore> bores(const TriMesh& mesh) {
  const auto neighbours = triangle_neighbours(mesh);
  const std::size_t count = mesh.triangle_count();
  std::vector<char> hollow(count, 0);
  std::vector<std::array<double, 3>> turns(count, {0, 0, 0});
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const TriId other = neighbours[TriId(t)][k];
      if (!other.valid()) continue;
      turns[t][k] = inward_turn(mesh, TriId(t), other);
      if (turns[t][k] > least_turn && turns[t][k] < largest_turn) hollow[t] = 1;
    }
  UnionFind parts(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const TriId other = neighbours[TriId(t)][k];
      if (other.valid() && hollow[t] && hollow[other.index()] && turns[t][k] > -least_turn &&
          turns[t][k] < largest_turn)
        parts.join(t, other.index());
    }
  std::map<std::size_t, std::vector<TriId>> members;
  for (std::size_t t = 0; t < count; ++t)
    if (hollow[t]) members[parts.root(t)].emplace_back(t);
  std::vector<Bore> out;
  for (const auto& [root, triangles] : members) {
    if (triangles.size() < fewest) continue;
    Vec3 center = Vec3::Zero(), sum = Vec3::Zero();
    double area = 0, inward = 0, radius = 0;
    for (TriId t : triangles) {
      const Vec3 a = area_vector(mesh, t);
      center += a.norm() * centroid(mesh, t);
      sum += a;
      area += a.norm();
    }
    center /= area;
    for (TriId t : triangles) {
      const Vec3 a = area_vector(mesh, t);
      const double distance = a.dot(center - centroid(mesh, t));
      radius += distance / area;
      if (distance > 0) inward += a.norm();
    }
    if (sum.norm() < balance * area && inward > pointing_in * area) out.push_back({center, radius});
  }
  return out;
}

}  // namespace conchoid
