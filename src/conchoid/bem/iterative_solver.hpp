#pragma once

#include <functional>
#include <span>

#include "conchoid/bem/body_solver.hpp"

namespace conchoid {

struct IterationSettings {
  double tolerance = 1e-12;  ///< of the residual, in the norm of the preconditioner, relative to b
  std::size_t most_iterations = 5000;
};

/// Conjugate gradients for a symmetric positive definite matrix that is only applied.
/// @param apply     y = A x
/// @param diagonal  of A, or of something like it: Jacobi preconditioner, positive
/// @param b         right-hand side; the solution takes its place
/// @return number of iterations. Errors: ComputationError when the tolerance is not reached.
std::size_t conjugate_gradients(const std::function<void(const double* x, double* y)>& apply,
                                std::span<const double> diagonal, std::span<double> b,
                                const IterationSettings& settings = {});

/// A⁻¹ b by nothing but products with A = | V −K ; Kᵀ D |: conjugate gradients on the Schur complement
/// S = D + Kᵀ V⁻¹ K, with conjugate gradients on V inside.
/// @param apply                y = A x, x = (q, u)
/// @param tractions            length of q
/// @param diagonal             of V, then of D
void solve_by_products(const std::function<void(const double* x, double* y)>& apply, std::size_t tractions,
                       std::span<const double> diagonal, std::span<double> b,
                       const IterationSettings& settings = {});

/// Keeps V, K and D and never factors them: for comparison, and as a model of solvers that have no factors
/// (compressed matrices). α of the rigid motions is the mean of D's diagonal.
/// Memory for n triangles, a share h of them held: 18 n² (1 + 3 h²) bytes; 28 n² more while the entries are
/// integrated.
std::unique_ptr<BodySolver> make_iterative_solver(BodyEntries& entries, const RigidMotions& motions,
                                                  const KeptSystem& kept = {});

}  // namespace conchoid
