#include "conchoid/mesh/ray_exit.hpp"

#include <algorithm>
#include <limits>

namespace conchoid {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double on_edge = 1e-9;  // × area: rays through an edge belong to both of its triangles

}  // namespace

double exit_distance(const Triangle& t, const Vec3& x, const Vec3& direction, double least_cosine) {
  const Vec3 a = t[1] - t[0], b = t[2] - t[0], from = x - t[0];
  const Vec3 area = cross(a, b);
  const double along = direction.dot(area), size = area.norm();
  if (!(along > least_cosine * size)) return infinite;
  const Vec3 side = cross(direction, from);
  const double u = side.dot(b) / along, v = -side.dot(a) / along;
  if (u < -on_edge || v < -on_edge || u + v > 1 + on_edge) return infinite;
  return -from.dot(area) / along;
}

double exit_distance(const TriMesh& surface, const BoxTree& tree, const Vec3& x, const Vec3& direction) {
  double nearest = infinite;
  tree.visit_along(x, direction, infinite, [&](TriId t) {
    const double s = exit_distance(surface.triangle(t), x, direction);
    if (s > 0) nearest = std::min(nearest, s);
    return nearest;
  });
  return nearest;
}

}  // namespace conchoid
