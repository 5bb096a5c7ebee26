#include "conchoid/mesh/closest_point.hpp"

#include <algorithm>

namespace conchoid {
namespace {

Vec3 closest_point_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  if (!(length2 > 0)) return a;
  const double s = std::clamp((x - a).dot(ab) / length2, 0.0, 1.0);
  return s == 1.0 ? b : Vec3(a + s * ab);
}

}  // namespace

Vec3 closest_point_on_triangle(const Triangle& triangle, const Vec3& x) {
  const auto& [a, b, c] = triangle;
  const Vec3 n = area_vector2(a, b, c);
  const double n2 = n.squaredNorm();
  // Signed areas of the three sub-triangles that the foot of the perpendicular makes with the edges.
  if (n2 > 0) {
    const double wa = n.dot(cross(b - x, c - x)), wb = n.dot(cross(c - x, a - x)),
                 wc = n.dot(cross(a - x, b - x));
    if (wa >= 0 && wb >= 0 && wc >= 0) return x - n * (n.dot(x - a) / n2);
  }
  Vec3 best = closest_point_on_segment(a, b, x);
  for (const Vec3& candidate : {closest_point_on_segment(b, c, x), closest_point_on_segment(c, a, x)})
    if ((candidate - x).squaredNorm() < (best - x).squaredNorm()) best = candidate;
  return best;
}

namespace {

// Puts triangle t into its place; returns the bound for those still to come.
double compare(const Triangle& triangle, TriId t, const Vec3& x, ClosestHit& best) {
  const Vec3 point = closest_point_on_triangle(triangle, x);
  const double d2 = (point - x).squaredNorm();
  if (d2 < best.squared_distance || (d2 == best.squared_distance && t < best.triangle)) best = {t, point, d2};
  return best.squared_distance;
}

}  // namespace

ClosestHit closest_point(const TriMesh& mesh, const Vec3& x) {
  ClosestHit best;
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value) {
    const Triangle triangle = mesh.triangle(t);
    if (squared_distance(box_of(triangle), x) <= best.squared_distance) compare(triangle, t, x, best);
  }
  return best;
}

ClosestPointTree::ClosestPointTree(const TriMesh& mesh) : tree_(mesh) {
  triangles_.reserve(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    triangles_.push_back(mesh.triangle(TriId(t)));
}

ClosestPointTree::Hit ClosestPointTree::closest(const Vec3& x) const {
  Hit best;
  tree_.visit_near(x, best.squared_distance,
                   [&](TriId t) { return compare(triangles_[t.index()], t, x, best); });
  return best;
}

}  // namespace conchoid
