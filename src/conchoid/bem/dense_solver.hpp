#pragma once

#include "conchoid/bem/body_solver.hpp"

namespace conchoid {

/// Cholesky factors of V and of the Schur complement S = D + Kᵀ V⁻¹ K + α Σ r rᵀ, α = tr(D + Kᵀ V⁻¹ K)/dim:
///   V = L Lᵀ ,   W = L⁻¹ K ,   S = D + Wᵀ W + α Σ r rᵀ
///   u = S⁻¹ (b_u − Wᵀ L⁻¹ b_q) ,   q = L⁻ᵀ (L⁻¹ b_q + W u)
/// Entries are integrated straight into the tiles of the factors; A itself is not kept, apply() multiplies the
/// factors. The same bits for every number of threads.
/// Memory for n triangles, a share h of them held: 4 (tractions + displacements)² = 9 n² (1 + h)² bytes and half
/// a row of tiles each; 28 n² more while the entries are integrated.
/// Factors that are kept have the bits of those that are made.
std::unique_ptr<BodySolver> make_dense_solver(BodyEntries& entries, const RigidMotions& motions,
                                              const KeptSystem& kept = {});

}  // namespace conchoid
