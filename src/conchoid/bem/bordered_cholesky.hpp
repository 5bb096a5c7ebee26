#pragma once

#include <cstddef>
#include <memory>

namespace conchoid {

/// Lower Cholesky factor L of a symmetric positive definite matrix A = L Lᵀ that grows and shrinks at its
/// end: appended unknowns cost O(n² m) for m new ones and leave the factor of the old ones untouched.
/// docs/theory.md (B6)
class BorderedCholesky {
 public:
  std::size_t size() const { return n_; }

  /// Appends unknowns.
  /// @param rows   rows of A that belong to them, size() + count numbers each, row-major; what lies above the
  ///               diagonal is not read
  /// @param lead   from one row to the next
  /// @return false when the grown matrix is not positive definite; the factor is then as before
  [[nodiscard]] bool append(const double* rows, std::size_t lead, std::size_t count);

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
