#pragma once

#include <algorithm>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

inline Box box_of(const Triangle& t) {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

/// The smallest box around both.
inline Box united(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

/// Wider by `reach` on every side.
inline Box grown(const Box& box, double reach) {
  return {(box.low.array() - reach).matrix(), (box.high.array() + reach).matrix()};
}

/// Touching counts.
inline bool overlap(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// Whether the ray x + s·direction comes into the box, or within round-off of it, at some 0 ≤ s ≤ bound.
inline bool may_meet(const Box& box, const Vec3& x, const Vec3& direction, double bound) {
  constexpr double round_off = 1e-12;
  const double slack = round_off * ((box.high - x).cwiseAbs().cwiseMax((box.low - x).cwiseAbs())).maxCoeff();
  double enters = 0, leaves = bound;
  for (int k = 0; k < 3; ++k) {
    const double low = box.low[k] - slack - x[k], high = box.high[k] + slack - x[k];
    if (direction[k] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / direction[k], b = high / direction[k];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

/// From x to the nearest point of the box, zero inside [m²].
inline double squared_distance(const Box& box, const Vec3& x) {
  return (box.low - x).cwiseMax(x - box.high).cwiseMax(0.0).squaredNorm();
}

}  // namespace conchoid
