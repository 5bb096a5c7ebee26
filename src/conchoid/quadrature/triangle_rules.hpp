#pragma once

#include <span>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// One point of a rule on a triangle: barycentric coordinates, and its share of the area.
struct RulePoint {
  double l0, l1, l2, weight;
};

/// A fully symmetric rule with positive weights and inside points, exact for polynomials up to `degree`
/// (Dunavant 1985 orbit structures; positions and weights solved for to long double accuracy).
struct TriangleRule {
  int degree;
  std::span<const RulePoint> points;
};

/// All rules by ascending degree: 2 4 5 6 8 9 10 11 12 with 3 6 7 12 16 19 25 28 33 points.
std::span<const TriangleRule> triangle_rules();
/// The rule of that degree. @pre it exists.
const TriangleRule& triangle_rule(int degree);

inline Vec3 rule_point(const Triangle& t, const RulePoint& p) {
  return p.l0 * t[0] + p.l1 * t[1] + p.l2 * t[2];
}

}  // namespace conchoid
