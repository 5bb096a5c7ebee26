#include "conchoid/bem/interior_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/parallel.hpp"
#include "conchoid/quadrature/lanes.hpp"
#include "conchoid/quadrature/polynomial_pairs.hpp"

namespace conchoid {
namespace {

constexpr int kDeepest = 12;

/// What `lanes` points of a panel give: d = y − x [m], traction, density, and the weight of each.
struct PanelPoints {
  Lanes d[3], traction[3], density[3];
  Lanes weight;
};

/// Six components, 00 11 22 12 02 01, summed up over points.
using StressSum = std::array<double, 6>;

struct StressFactors {
  double nu, of_traction, of_density;  // 1/(8π(1−ν)) and µ/(4π(1−ν))
};

// Adds kelvin_stress(d, t) − kelvin_dislocation_stress(d, n, w), of both what goes with e eᵀ, with I, and with
// the symmetric products of e and of n.
CONCHOID_WIDE_CLONES void add_point_stress(const PanelPoints* groups, int count, const double (&n)[3],
                                           const StressFactors& f, StressSum& sum) {
  const double nu = f.nu, a = 1 - 2 * nu;
  Lanes total[6] = {};
  for (int g = 0; g < count; ++g) {
    const PanelPoints& p = groups[g];
    Lanes r = p.d[0] * p.d[0] + p.d[1] * p.d[1] + p.d[2] * p.d[2];
    take_root(r);
    const Lanes inverse = 1.0 / r, ct = f.of_traction * p.weight * inverse * inverse,
                cd = f.of_density * p.weight * inverse * inverse * inverse;
    Lanes e[3], v[3];
    for (int k = 0; k < 3; ++k)
      e[k] = p.d[k] * inverse;
    const Lanes te = p.traction[0] * e[0] + p.traction[1] * e[1] + p.traction[2] * e[2];
    const Lanes we = p.density[0] * e[0] + p.density[1] * e[1] + p.density[2] * e[2];
    const Lanes en = e[0] * n[0] + e[1] * n[1] + e[2] * n[2];
    const Lanes wn = p.density[0] * n[0] + p.density[1] * n[1] + p.density[2] * n[2];
    for (int k = 0; k < 3; ++k)
      v[k] = ct * a * p.traction[k] - cd * 3 * nu * (en * p.density[k] + we * n[k]);
    const Lanes along = 3 * ct * te + cd * (15 * en * we - 3 * a * wn);
    const Lanes equal = cd * ((1 - 4 * nu) * wn - 3 * a * en * we) - ct * a * te;
    const Lanes across = -a * cd;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      total[k] += along * e[k] * e[k] + 2 * e[k] * v[k] + equal + 2 * across * n[k] * p.density[k];
      total[3 + k] += along * e[i] * e[j] + e[i] * v[j] + v[i] * e[j] +
                      across * (n[i] * p.density[j] + n[j] * p.density[i]);
    }
  }
  for (int k = 0; k < 6; ++k)
    sum[k] += (total[k][0] + total[k][1]) + (total[k][2] + total[k][3]);
}

struct RulePoints {
  Lanes barycentric[3];
  Lanes weight;
};
struct PanelRule {
  int groups;
  RulePoints points[2];
};

// Four points, exact to degree 3 (Strang & Fix 1973).
const PanelRule& far_rule() {
  static const PanelRule rule{
      1,
      {{{{1.0 / 3, 0.6, 0.2, 0.2}, {1.0 / 3, 0.2, 0.6, 0.2}, {1.0 / 3, 0.2, 0.2, 0.6}},
        {-27.0 / 48, 25.0 / 48, 25.0 / 48, 25.0 / 48}}}};
  return rule;
}

// Seven points, exact to degree 5 (Radon 1948); the eighth counts nothing.
const PanelRule& near_rule() {
  static const PanelRule rule = [] {
    const double s = std::sqrt(15.0), third = 1.0 / 3;
    const double a = (6 - s) / 21, b = (6 + s) / 21;
    const double wa = (155 - s) / 1200, wb = (155 + s) / 1200;
    return PanelRule{
        2,
        {{{{third, 1 - 2 * a, a, a}, {third, a, 1 - 2 * a, a}, {third, a, a, 1 - 2 * a}},
          {9.0 / 40, wa, wa, wa}},
         {{{1 - 2 * b, b, b, third}, {b, 1 - 2 * b, b, third}, {b, b, 1 - 2 * b, third}}, {wb, wb, wb, 0}}}};
  }();
  return rule;
}

// Of three values at corners, at the points of a rule.
CONCHOID_INTO_CLONES void take_between(const RulePoints& at, double x, double y, double z, Lanes& result) {
  result = at.barycentric[0] * x + at.barycentric[1] * y + at.barycentric[2] * z;
}

// What a part of a panel carries: `size_to_distance` up to which rules are taken, data at barycentric coordinates
// of the part, and that of its quarters.
struct LinearPart {
  static constexpr double size_to_distance = 0.6, far_size_to_distance = 0.12;
  const LoadedPanel& panel;
  std::array<Vec3, 3> w;

  void place(const RulePoints& at, PanelPoints& points) const {
    for (int k = 0; k < 3; ++k) {
      points.traction[k] = Lanes{} + panel.traction[k];
      take_between(at, w[0][k], w[1][k], w[2][k], points.density[k]);
    }
  }
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
  // What walls feel is a small difference of their two sides.
  static constexpr double size_to_distance = 0.4, far_size_to_distance = 0.06;
  const QuadraticLoadedPanel& panel;
  std::array<Vec3, 3> l;  // corners of the part, in barycentric coordinates of the panel

  void place(const RulePoints& at, PanelPoints& points) const {
    for (int i = 0; i < lanes; ++i) {
      const Vec3 N = at.barycentric[0][i] * l[0] + at.barycentric[1][i] * l[1] + at.barycentric[2][i] * l[2];
      const Vec3 traction = N[0] * panel.traction[0] + N[1] * panel.traction[1] + N[2] * panel.traction[2];
      const Eigen::Matrix<double, 6, 1> phi = quadratic_functions(N);
      Vec3 density = Vec3::Zero();
      for (int k = 0; k < 6; ++k)
        density += phi[k] * panel.density[static_cast<std::size_t>(k)];
      for (int k = 0; k < 3; ++k) {
        points.traction[k][i] = traction[k];
        points.density[k][i] = density[k];
      }
    }
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

// Of one point, over panels.
class StressAt {
 public:
  StressAt(const Vec3& x, const ElasticConstants& m)
      : x_(x),
        factors_{m.poisson_ratio, 1 / (8 * std::numbers::pi * (1 - m.poisson_ratio)),
                 m.shear_modulus() / (4 * std::numbers::pi * (1 - m.poisson_ratio))} {}

  template <class Part>
  void add(const Triangle& y, const Part& part, int depth = 0) {
    const double size2 =
        std::max({(y[0] - y[1]).squaredNorm(), (y[1] - y[2]).squaredNorm(), (y[2] - y[0]).squaredNorm()});
    const double distance2 = ((y[0] + y[1] + y[2]) / 3 - x_).squaredNorm();
    const auto within = [&](double ratio) { return size2 <= ratio * ratio * distance2; };
    if (!within(Part::size_to_distance) && depth < kDeepest) {
      Triangle middle;
      for (int k = 0; k < 3; ++k)
        middle[k] = 0.5 * (y[k] + y[(k + 1) % 3]);
      const std::array<Part, 4> quarters = part.quarters();
      for (int k = 0; k < 3; ++k)
        add({y[k], middle[k], middle[(k + 2) % 3]}, quarters[static_cast<std::size_t>(k)], depth + 1);
      add(middle, quarters[3], depth + 1);
      return;
    }
    const PanelRule& rule = within(Part::far_size_to_distance) ? far_rule() : near_rule();
    const double area = 0.5 * area_vector2(y[0], y[1], y[2]).norm();
    const Vec3& n = part.panel.panel.normal;
    PanelPoints groups[2];
    for (int g = 0; g < rule.groups; ++g) {
      const RulePoints& at = rule.points[g];
      for (int k = 0; k < 3; ++k) {
        take_between(at, y[0][k], y[1][k], y[2][k], groups[g].d[k]);
        groups[g].d[k] -= x_[k];
      }
      part.place(at, groups[g]);
      groups[g].weight = area * at.weight;
    }
    add_point_stress(groups, rule.groups, {n[0], n[1], n[2]}, factors_, sum_);
  }

  Mat3 stress() const {
    Mat3 s;
    s << sum_[0], sum_[5], sum_[4], sum_[5], sum_[1], sum_[3], sum_[4], sum_[3], sum_[2];
    return s;
  }

 private:
  Vec3 x_;
  StressFactors factors_;
  StressSum sum_{};
};

}  // namespace

std::vector<Mat3> interior_stress(std::span<const Vec3> points, const std::vector<LoadedPanel>& panels,
                                  const ElasticConstants& m) {
  std::vector<Mat3> stress(points.size());
  parallel_for(points.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      StressAt at(points[i], m);
      for (const LoadedPanel& p : panels)
        at.add(p.panel.x, LinearPart{p, p.density});
      stress[i] = at.stress();
    }
  });
  return stress;
}

Mat3 interior_stress(const Vec3& point, const std::vector<QuadraticLoadedPanel>& panels,
                     const ElasticConstants& m) {
  StressAt at(point, m);
  for (const QuadraticLoadedPanel& p : panels)
    at.add(p.panel.x, QuadraticPart{p, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}});
  return at.stress();
}

}  // namespace conchoid
