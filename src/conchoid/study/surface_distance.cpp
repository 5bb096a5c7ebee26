#include "conchoid/study/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {
namespace {

struct SurfaceSample {
  Vec3 point;
  double area;  ///< that it stands for [m²]
};

double fraction(double x) {
  return x - std::floor(x);
}

/// Points spread over every triangle in proportion to its area; within a triangle the R2 sequence (Roberts
/// 2018), folded at the diagonal.
std::vector<SurfaceSample> spread_samples(const TriMesh& mesh, std::size_t samples) {
  const double total = surface_area(mesh);
  std::vector<SurfaceSample> out;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double area = area_vector(mesh, TriId(t)).norm();
    if (!(area > 0)) continue;
    const auto count = static_cast<std::size_t>(std::ceil(static_cast<double>(samples) * (area / total)));
    const auto [a, b, c] = mesh.triangle(TriId(t));
    for (std::size_t i = 0; i < count; ++i) {
      double u = fraction(0.5 + 0.7548776662466927 * static_cast<double>(i));
      double v = fraction(0.5 + 0.5698402909980532 * static_cast<double>(i));
      if (count == 1) u = v = 1.0 / 3.0;
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      out.push_back({a + u * (b - a) + v * (c - a), area / static_cast<double>(count)});
    }
  }
  return out;
}

}  // namespace

SurfaceDistance one_sided_distance(const TriMesh& from, const TriMesh& to, std::size_t samples) {
  const std::vector<SurfaceSample> points = spread_samples(from, samples);
  const ClosestPointTree tree(to);
  auto distance_and_area = parallel_values(points.size(), 256, [&](std::size_t i) {
    return std::pair(std::sqrt(tree.closest(points[i].point).squared_distance), points[i].area);
  });
  std::sort(distance_and_area.begin(), distance_and_area.end());
  double area = 0, sum = 0;
  for (const auto& [d, a] : distance_and_area) {
    area += a;
    sum += d * a;
  }
  SurfaceDistance result;
  if (!(area > 0)) return result;
  result.mean = sum / area;
  double below = 0;
  for (const auto& [d, a] : distance_and_area) {
    result.p95 = d;
    below += a;
    if (below >= 0.95 * area) break;
  }
  return result;
}

SurfaceDistance symmetric_distance(const TriMesh& a, const TriMesh& b, std::size_t samples) {
  if (a.triangle_count() == 0 && b.triangle_count() == 0) return {};
  if (a.triangle_count() == 0 || b.triangle_count() == 0) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  const SurfaceDistance ab = one_sided_distance(a, b, samples), ba = one_sided_distance(b, a, samples);
  return {0.5 * (ab.mean + ba.mean), 0.5 * (ab.p95 + ba.p95)};
}

}  // namespace conchoid
