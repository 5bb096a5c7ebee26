#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/potentials.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

/// Integrals of a panel's potential over another panel nearby, on cells.
namespace conchoid {

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double s = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - s * ab).norm();
}

inline double distance_to_panel(const Vec3& p, const PanelPotential& panel) {
  if (panel.corner_functions(p).minCoeff() >= 0) return std::abs(panel.height(p));
  return std::min({distance_to_segment(p, panel.corner(0), panel.corner(1)),
                   distance_to_segment(p, panel.corner(1), panel.corner(2)),
                   distance_to_segment(p, panel.corner(2), panel.corner(0))});
}

inline Vec3 center_of(const Triangle& t) {
  return (t[0] + t[1] + t[2]) / 3;
}

inline double radius_of(const Triangle& t, const Vec3& center) {
  return std::max({(t[0] - center).norm(), (t[1] - center).norm(), (t[2] - center).norm()});
}

/// ∫ over a triangle: cut at the longest edge until a rule suffices. False, and nothing of use in sum, when
/// that would take more than `budget` points.
/// @param degree_of  degree of the rule that does for a cell, 0 when none does
/// @param mean_of  mean_of(corners, rule), the rule's mean over a cell
template <int N, class Degree, class Mean>
bool over_cells(const Triangle& whole, double area, const Degree& degree_of, int budget, const Mean& mean_of,
                Eigen::Matrix<double, N, 1>& sum) {
  struct Cell {
    Triangle corners;
    double area;
  };
  sum.setZero();
  std::array<Cell, 40> stack;
  int top = 0;
  stack[top++] = {whole, area};
  while (top > 0) {
    const Cell cell = stack[--top];
    const Triangle& t = cell.corners;
    const int degree = degree_of(t);
    if (degree > 0) {
      const TriangleRule& rule = triangle_rule(degree);
      budget -= static_cast<int>(rule.points.size());
      if (budget < 0) return false;
      sum += cell.area * mean_of(t, rule);
      continue;
    }
    if (top + 2 > static_cast<int>(stack.size())) return false;
    budget -= 3;
    const std::array<double, 3> length2 = {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(),
                                           (t[0] - t[2]).squaredNorm()};
    const int i = static_cast<int>(std::max_element(length2.begin(), length2.end()) - length2.begin());
    const Vec3 mid = 0.5 * (t[i] + t[(i + 1) % 3]);
    stack[top++] = {{t[i], mid, t[(i + 2) % 3]}, cell.area / 2};
    stack[top++] = {{mid, t[(i + 1) % 3], t[(i + 2) % 3]}, cell.area / 2};
  }
  return true;
}

/// Mean over a triangle of f, point by point.
template <int N, class F>
Eigen::Matrix<double, N, 1> rule_mean(const Triangle& t, const TriangleRule& rule, const F& f) {
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (const RulePoint& p : rule.points)
    sum += p.weight * f(rule_point(t, p));
  return sum;
}

}  // namespace conchoid
