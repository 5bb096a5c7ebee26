#include "conchoid/mesh/wall_thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/ray_exit.hpp"

namespace conchoid {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t rays = 7, grain = 256;
constexpr double tilt = 20 * std::numbers::pi / 180;
constexpr double least_cosine = 0.5;  // between a ray and the normal of the face that it leaves through
constexpr double on_surface = 1e-9;   // × reach: what is so near is the point's own face

// Calls visit(t) for every triangle that the ray may meet, as BoxTree::visit_along.
class AllTriangles {
 public:
  explicit AllTriangles(const TriMesh& mesh) : mesh_(mesh) {}
  template <class Visit>
  void visit_along(const Vec3& x, const Vec3& direction, double bound, const Visit& visit) const {
    for (TriId t(0); t.index() < mesh_.triangle_count(); ++t.value)
      if (may_meet(box_of(mesh_.triangle(t)), x, direction, bound)) bound = visit(t);
  }

 private:
  const TriMesh& mesh_;
};

template <class Triangles>
double depth(const TriMesh& body, const Triangles& triangles, const Vec3& x, const Vec3& direction,
             double reach) {
  double nearest = infinite;
  triangles.visit_along(x, direction, reach, [&](TriId t) {
    const double s = exit_distance(body.triangle(t), x, direction, least_cosine);
    if (s > on_surface * reach && s < nearest) nearest = s;
    return std::min(nearest, reach);
  });
  return nearest;
}

template <class Triangles>
double thickness_at(const TriMesh& body, const Triangles& triangles, const Vec3& x, const Vec3& normal,
                    double reach) {
  const Vec3 inward = -normal;
  Vec3::Index least;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 across = cross(normal, Vec3::Unit(least)).normalized(), third = cross(normal, across);
  std::array<double, rays> depths;
  depths[0] = depth(body, triangles, x, inward, reach);
  for (std::size_t i = 1; i < rays; ++i) {
    const double turn = static_cast<double>(i) * 2 * std::numbers::pi / (rays - 1);
    const Vec3 direction =
        std::cos(tilt) * inward + std::sin(tilt) * (std::cos(turn) * across + std::sin(turn) * third);
    depths[i] = std::cos(tilt) * depth(body, triangles, x, direction, reach / std::cos(tilt));
  }
  std::nth_element(depths.begin(), depths.begin() + rays / 2, depths.end());
  return depths[rays / 2] <= reach ? depths[rays / 2] : infinite;
}

}  // namespace

double wall_thickness(const TriMesh& body, const Vec3& x, const Vec3& normal, double reach) {
  return thickness_at(body, AllTriangles(body), x, normal, reach);
}

WallProbe::WallProbe(const TriMesh& body) : body_(body), tree_(body) {}

double WallProbe::thickness(const Vec3& x, const Vec3& normal, double reach) const {
  return thickness_at(body_, tree_, x, normal, reach);
}

IdVector<TriId, double> WallProbe::thickness(const IdVector<TriId, double>& reach) const {
  IdVector<TriId, double> out(body_.triangle_count(), infinite);
  parallel_for(body_.triangle_count(), grain, [&](std::size_t begin, std::size_t end) {
    for (TriId t(begin); t.index() < end; ++t.value) {
      if (!(reach[t] > 0)) continue;
      const Vec3 normal = unit_normal(body_, t);
      if (normal.squaredNorm() > 0) out[t] = thickness(centroid(body_, t), normal, reach[t]);
    }
  });
  return out;
}

double mean_square_edge(const Triangle& t) {
  return std::sqrt(((t[1] - t[0]).squaredNorm() + (t[2] - t[1]).squaredNorm() + (t[0] - t[2]).squaredNorm()) /
                   3);
}

}  // namespace conchoid
