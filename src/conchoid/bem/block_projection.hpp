#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Makes a 3×3 block B of an operator that of the system: P B Q with the projections onto what is unknown, and
/// s (I − P) more, s a third of the block's trace, where a triangle or node meets itself. docs/theory.md (B9)
/// @param at  its entry (p, q) is at at[p·row + q·column]
inline void project_block(double* at, std::size_t row, std::size_t column, const Mat3& P, const Mat3& Q,
                          bool itself) {
  if (P.isIdentity(0) && Q.isIdentity(0)) return;
  using Stride = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::Map<Mat3, 0, Stride> block(
      at, Stride(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(row)));
  Mat3 of_system = P * block * Q;
  if (itself) of_system += block.trace() / 3 * (Mat3::Identity() - P);
  block = of_system;
}

}  // namespace conchoid
