#pragma once

#include <algorithm>
#include <array>

#include "conchoid/quadrature/lanes.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

/// Rules' points in arrays, for loops over pairs of points.
namespace conchoid {

constexpr int max_points = 36;
constexpr int max_degree = 12;

/// A rule's points as arrays, filled up to a multiple of the lanes with points of weight 0.
struct RuleArrays {
  int count = 0, padded = 0;
  alignas(32) double l[3][max_points];
  alignas(32) double weight[max_points];
};

inline const RuleArrays& rule_arrays(int degree) {
  static const auto table = [] {
    std::array<RuleArrays, max_degree + 1> all{};
    for (const TriangleRule& rule : triangle_rules()) {
      RuleArrays& to = all[static_cast<std::size_t>(rule.degree)];
      to.count = static_cast<int>(rule.points.size());
      to.padded = (to.count + lanes - 1) / lanes * lanes;
      for (int i = 0; i < to.padded; ++i) {
        const RulePoint& p = rule.points[static_cast<std::size_t>(std::min(i, to.count - 1))];
        to.l[0][i] = p.l0;
        to.l[1][i] = p.l1;
        to.l[2][i] = p.l2;
        to.weight[i] = i < to.count ? p.weight : 0.0;
      }
    }
    return all;
  }();
  return table[static_cast<std::size_t>(degree)];
}

/// The rule's points on one panel, one array per coordinate.
struct PlacedPoints {
  const RuleArrays* rule;
  alignas(32) double at[3][max_points];

  PlacedPoints(const Triangle& t, int degree) : rule(&rule_arrays(degree)) {
    for (int k = 0; k < 3; ++k) {
      const double a = t[0][k], b = t[1][k], c = t[2][k];
      for (int i = 0; i < rule->padded; ++i)
        at[k][i] = rule->l[0][i] * a + rule->l[1][i] * b + rule->l[2][i] * c;
    }
  }
};

}  // namespace conchoid
