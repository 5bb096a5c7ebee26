#pragma once

#include <cstdint>

#include "conchoid/material/field_sample.hpp"

namespace conchoid {

/// Voronoi grains around one random point per cell of a lattice, weakened along their boundaries:
///     (Σ_i W_i m_i) · (1 − w)^B,   B = Σ_{i<j} exp(−(2 d_ij/b)²) (W_i + W_j)³
/// d_ij distance from the plane halfway between points i and j; W_i soft Voronoi weights, ∝ exp(−2
/// |x−p_i|²/b) in units of the grain size, faded out beyond two grains; m_i = 1 ± s, uniform, the grain's own
/// factor. On a boundary B ≈ 1, where three or more grains meet a little less; inside of grains the value is
/// m_i. Smooth everywhere.
struct Grains {
  double size = 1;           ///< grain size [m]: cube root of the mean volume, > 0
  Vec3 stretch = {1, 1, 1};  ///< factors along the axes, > 0: elongated or flat grains
  double width = 0.1;        ///< b [m] of the boundaries (stretched with the grains), > 0
  double weakening = 0;      ///< w of the boundaries, 0 … 1 (1 excluded)
  double spread = 0;         ///< s of the grains, 0 … 1 (1 excluded)
  std::uint64_t seed = 1;

  FieldSample at(const Vec3& x) const;
};

}  // namespace conchoid
