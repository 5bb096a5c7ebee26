#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace conchoid {

/// Lower Cholesky factor L of a symmetric positive definite matrix A = L Lᵀ that grows and shrinks at its
/// end: appended unknowns cost O(n² m) for m new ones and leave the factor of the old ones untouched.
/// docs/theory.md (B6)
class BorderedCholesky {
 public:
  std::size_t size() const { return n_; }

  /// Appends m unknowns.
  /// @param coupling  m × size() block of A between new and old unknowns, row-major
  /// @param diagonal  m × m block of A among the new ones, row-major; its lower triangle is read
  /// @return false when the grown matrix is not positive definite; the factor is then as before
  [[nodiscard]] bool append(const std::vector<double>& coupling, const std::vector<double>& diagonal);

  /// Keeps the first n unknowns.
  void truncate(std::size_t n);

  /// Solves A x = b in place for `count` right-hand sides, each contiguous and `size()` long.
  void solve(double* b, std::size_t count = 1) const;

 private:
  void reserve(std::size_t n);

  std::size_t n_ = 0;
  double scale_ = 1;                  // of A: unit_scale of its first entry
  std::size_t capacity_ = 0;          // leading dimension
  std::unique_ptr<double[]> factor_;  // column-major, lower triangle; nothing is ever put above it
};

}  // namespace conchoid
