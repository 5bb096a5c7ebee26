#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

inline Box box_of(const Triangle& t) {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

/// The smallest box around both.
inline Box united(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

/// Touching counts.
inline bool overlap(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// From x to the nearest point of the box, zero inside [m²].
inline double squared_distance(const Box& box, const Vec3& x) {
  return (box.low - x).cwiseMax(x - box.high).cwiseMax(0.0).squaredNorm();
}

}  // namespace conchoid
