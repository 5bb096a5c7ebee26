#pragma once

#include <cstddef>

namespace conchoid {

/// Solves with a body's system A (BodySolver) by halves. With J = diag(−1, 1) on (q, u), J A is symmetric, and
///   A⁻¹ = Pᵀ M P J ,  M symmetric ,
/// so that products (J v)ᵀ A⁻¹ w take the first step of each vector alone: (P J v)ᵀ M (P J w).
/// All in place, several vectors one after the other. Errors: ComputationError when an iteration does not converge.
class HalfSolver {
 public:
  virtual ~HalfSolver() = default;
  virtual void reduce(double* b, std::size_t count = 1) const = 0;  ///< P J b
  virtual void middle(double* b, std::size_t count = 1) const = 0;  ///< M b
  virtual void expand(double* b, std::size_t count = 1) const = 0;  ///< Pᵀ b
  /// A⁻¹ b.
  void solve(double* b, std::size_t count = 1) const {
    reduce(b, count);
    middle(b, count);
    expand(b, count);
  }
};

}  // namespace conchoid
