#include "conchoid/bem/interior_stress.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/elastic/kelvin.hpp"
#include "conchoid/quadrature/polynomial_pairs.hpp"

namespace conchoid {
namespace {

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

// What a part of a panel carries: `size_to_distance` up to which the rule is taken, data at barycentric coordinates
// of the part, and that of its quarters.
struct LinearPart {
  static constexpr double size_to_distance = 0.6;
  const LoadedPanel& panel;
  std::array<Vec3, 3> w;

  const Vec3& traction(const std::array<double, 3>&) const { return panel.traction; }
  Vec3 density(const std::array<double, 3>& b) const { return b[0] * w[0] + b[1] * w[1] + b[2] * w[2]; }
  std::array<LinearPart, 4> quarters() const {
    std::array<Vec3, 3> middle;
    for (int k = 0; k < 3; ++k)
      middle[k] = 0.5 * (w[k] + w[(k + 1) % 3]);
    return {{{panel, {w[0], middle[0], middle[2]}},
             {panel, {w[1], middle[1], middle[0]}},
             {panel, {w[2], middle[2], middle[1]}},
             {panel, middle}}};
  }
};

struct QuadraticPart {
  static constexpr double size_to_distance = 0.4;  // what walls feel is a small difference of their two sides
  const QuadraticLoadedPanel& panel;
  std::array<Vec3, 3> l;  // corners of the part, in barycentric coordinates of the panel

  Vec3 at(const std::array<double, 3>& b) const { return b[0] * l[0] + b[1] * l[1] + b[2] * l[2]; }
  Vec3 traction(const std::array<double, 3>& b) const {
    const Vec3 N = at(b);
    return N[0] * panel.traction[0] + N[1] * panel.traction[1] + N[2] * panel.traction[2];
  }
  Vec3 density(const std::array<double, 3>& b) const {
    const Eigen::Matrix<double, 6, 1> phi = quadratic_functions(at(b));
    Vec3 w = Vec3::Zero();
    for (int k = 0; k < 6; ++k)
      w += phi[k] * panel.density[static_cast<std::size_t>(k)];
    return w;
  }
  std::array<QuadraticPart, 4> quarters() const {
    std::array<Vec3, 3> middle;
    for (int k = 0; k < 3; ++k)
      middle[k] = 0.5 * (l[k] + l[(k + 1) % 3]);
    return {{{panel, {l[0], middle[0], middle[2]}},
             {panel, {l[1], middle[1], middle[0]}},
             {panel, {l[2], middle[2], middle[1]}},
             {panel, middle}}};
  }
};

template <class Part>
Mat3 panel_stress(const Vec3& x, const Triangle& y, const Part& part, const ElasticConstants& m, int depth) {
  const Vec3 center = (y[0] + y[1] + y[2]) / 3;
  const double size = std::max({(y[0] - y[1]).norm(), (y[1] - y[2]).norm(), (y[2] - y[0]).norm()});
  Mat3 sum = Mat3::Zero();
  if (size > Part::size_to_distance * (center - x).norm() && depth < kDeepest) {
    Triangle middle;
    for (int k = 0; k < 3; ++k)
      middle[k] = 0.5 * (y[k] + y[(k + 1) % 3]);
    const std::array<Part, 4> quarters = part.quarters();
    for (int k = 0; k < 3; ++k)
      sum += panel_stress(x, {y[k], middle[k], middle[(k + 2) % 3]}, quarters[static_cast<std::size_t>(k)], m,
                          depth + 1);
    return sum + panel_stress(x, middle, quarters[3], m, depth + 1);
  }
  const double area = 0.5 * area_vector2(y[0], y[1], y[2]).norm();
  for (const RulePoint& g : rule()) {
    const auto& b = g.barycentric;
    const Vec3 d = b[0] * y[0] + b[1] * y[1] + b[2] * y[2] - x;
    sum += g.weight * area *
           (kelvin_stress(d, part.traction(b), m) -
            kelvin_dislocation_stress(d, part.panel.panel.normal, part.density(b), m));
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
        stress[i] += panel_stress(points[i], p.panel.x, LinearPart{p, p.density}, m, 0);
  });
  return stress;
}

Mat3 interior_stress(const Vec3& point, const std::vector<QuadraticLoadedPanel>& panels,
                     const ElasticConstants& m) {
  Mat3 stress = Mat3::Zero();
  for (const QuadraticLoadedPanel& p : panels)
    stress +=
        panel_stress(point, p.panel.x, QuadraticPart{p, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}}, m, 0);
  return stress;
}

}  // namespace conchoid
