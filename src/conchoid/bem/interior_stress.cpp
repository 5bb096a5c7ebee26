#include "conchoid/bem/interior_stress.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/elastic/kelvin.hpp"

namespace conchoid {
namespace {

constexpr double kSizeToDistance = 0.6;
constexpr int kDeepest = 12;

// Seven-point rule, exact to degree 5 (Radon 1948).
struct RulePoint {
  double weight;
  std::array<double, 3> barycentric;
};
const std::array<RulePoint, 7>& rule() {
  static const std::array<RulePoint, 7> points = [] {
    const double s = std::sqrt(15.0);
    const double a = (6 - s) / 21, b = (6 + s) / 21;
    const double wa = (155 - s) / 1200, wb = (155 + s) / 1200;
    return std::array<RulePoint, 7>{{{9.0 / 40, {1.0 / 3, 1.0 / 3, 1.0 / 3}},
                                     {wa, {1 - 2 * a, a, a}},
                                     {wa, {a, 1 - 2 * a, a}},
                                     {wa, {a, a, 1 - 2 * a}},
                                     {wb, {1 - 2 * b, b, b}},
                                     {wb, {b, 1 - 2 * b, b}},
                                     {wb, {b, b, 1 - 2 * b}}}};
  }();
  return points;
}

Mat3 panel_stress(const Vec3& x, const Triangle& y, const std::array<Vec3, 3>& w, const LoadedPanel& p,
                  const ElasticConstants& m, int depth) {
  const Vec3 center = (y[0] + y[1] + y[2]) / 3;
  const double size = std::max({(y[0] - y[1]).norm(), (y[1] - y[2]).norm(), (y[2] - y[0]).norm()});
  Mat3 sum = Mat3::Zero();
  if (size > kSizeToDistance * (center - x).norm() && depth < kDeepest) {
    Triangle middle;
    std::array<Vec3, 3> w_middle;
    for (int k = 0; k < 3; ++k) {
      middle[k] = 0.5 * (y[k] + y[(k + 1) % 3]);
      w_middle[k] = 0.5 * (w[k] + w[(k + 1) % 3]);
    }
    for (int k = 0; k < 3; ++k)
      sum += panel_stress(x, {y[k], middle[k], middle[(k + 2) % 3]},
                          {w[k], w_middle[k], w_middle[(k + 2) % 3]}, p, m, depth + 1);
    return sum + panel_stress(x, middle, w_middle, p, m, depth + 1);
  }
  const double area = 0.5 * area_vector2(y[0], y[1], y[2]).norm();
  for (const RulePoint& g : rule()) {
    const auto& b = g.barycentric;
    const Vec3 d = b[0] * y[0] + b[1] * y[1] + b[2] * y[2] - x;
    const Vec3 density = b[0] * w[0] + b[1] * w[1] + b[2] * w[2];
    sum += g.weight * area *
           (kelvin_stress(d, p.traction, m) - kelvin_dislocation_stress(d, p.panel.normal, density, m));
  }
  return sum;
}

}  // namespace

std::vector<Mat3> interior_stress(std::span<const Vec3> points, const std::vector<LoadedPanel>& panels,
                                  const ElasticConstants& m) {
  std::vector<Mat3> stress(points.size(), Mat3::Zero());
  parallel_for(points.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const LoadedPanel& p : panels)
        stress[i] += panel_stress(points[i], p.panel.x, p.density, p, m, 0);
  });
  return stress;
}

}  // namespace conchoid
