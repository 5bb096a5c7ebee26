#include "conchoid/bem/interior_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// D_kij t_k and S_kij w_k for one pair of points, e = (y − x)/r, n the normal at y.
Mat3 traction_kernel(const Vec3& e, double r, const Vec3& t, double nu) {
  const double c = 1 / (8 * std::numbers::pi * (1 - nu) * r * r), te = t.dot(e), a = 1 - 2 * nu;
  return c *
         (a * (t * e.transpose() + e * t.transpose() - te * Mat3::Identity()) + 3 * te * e * e.transpose());
}

Mat3 density_kernel(const Vec3& e, double r, const Vec3& n, const Vec3& w, const ElasticConstants& m) {
  const double nu = m.poisson_ratio, a = 1 - 2 * nu, en = e.dot(n), we = w.dot(e), wn = w.dot(n);
  const double c = m.shear_modulus() / (4 * std::numbers::pi * (1 - nu) * r * r * r);
  const auto symmetric = [](const Vec3& p, const Vec3& q) -> Mat3 {
    return p * q.transpose() + q * p.transpose();
  };
  const Mat3 I = Mat3::Identity();
  return c * (3 * en * (a * we * I + nu * symmetric(w, e) - 5 * we * e * e.transpose()) +
              3 * nu * we * symmetric(n, e) + a * (3 * wn * e * e.transpose() + symmetric(n, w)) -
              (1 - 4 * nu) * wn * I);
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
    const double r = d.norm();
    const Vec3 density = b[0] * w[0] + b[1] * w[1] + b[2] * w[2];
    sum += g.weight * area *
           (traction_kernel(d / r, r, p.traction, m.poisson_ratio) -
            density_kernel(d / r, r, p.panel.normal, density, m));
  }
  return sum;
}

}  // namespace

Mat3 interior_stress(const Vec3& x, const std::vector<LoadedPanel>& panels, const ElasticConstants& m) {
  Mat3 stress = Mat3::Zero();
  for (const LoadedPanel& p : panels)
    stress += panel_stress(x, p.panel.x, p.density, p, m, 0);
  return stress;
}

}  // namespace conchoid
