#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace conchoid {

/// Lower Cholesky factor L of a symmetric positive definite matrix A = L Lᵀ that grows and shrinks at its
/// end: appended unknowns cost O(n² m) for m new ones and leave the factor of the old ones untouched.
/// docs/theory.md (B6)
class BorderedCholesky {
 public:
  std::size_t size() const { return n_; }

  /// Appends unknowns.
  /// @param row  of each of them, its row of A up to the diagonal: size() + i + 1 numbers for the i-th; called by
  ///             several threads
  /// @return false when the grown matrix is not positive definite; the factor is then as before
  [[nodiscard]] bool append(std::size_t count, const std::function<const double*(std::size_t)>& row);

  /// Keeps the first n unknowns.
  void truncate(std::size_t n);

  /// Solves A x = b in place for `count` right-hand sides, each contiguous and `size()` long.
  void solve(double* b, std::size_t count = 1) const;

 private:
  void reserve(std::size_t n);

  std::size_t n_ = 0;
  double scale_ = 1;                  // of A: unit_scale of its first entry
  std::size_t capacity_ = 0;          // leading dimension
  std::unique_ptr<double[]> factor_;  // row-major, lower triangle; nothing is ever put above it
};

}  // namespace conchoid
