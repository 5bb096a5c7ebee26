#pragma once

#include <span>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/dense_matrix.hpp"
#include "conchoid/bem/enrichment.hpp"
#include "conchoid/bem/pair_memory.hpp"

namespace conchoid {

/// The three rows that one vector-valued enrichment function adds to the system (test function f e_p,
/// p = 0, 1, 2). What they contribute to the right-hand side is
///   f_a = ½ (M g_N)_a − K_aᵀ g_N − D_a g_D + ∫ φ_a (σ° n)                              docs/theory.md (B7)
/// whose middle terms are −(sources · prescribed values); the others are enrichment_load().
struct EnrichmentRows {
  DenseMatrix body;  ///< 3 × body unknowns: K_aᵀ against the tractions, D against the displacements
  DenseMatrix
      enriched;  ///< 3 × 3·functions: D against the enrichment functions; none for those that come after it in
                 ///< `wanted`, as D is symmetric
  DenseMatrix sources;  ///< 3 × 3·sources: K_aᵀ of prescribed tractions, D of prescribed displacements
};

/// Rows of the functions listed in `wanted` (indices into space.functions), in that order.
/// @param sources  places of prescribed values whose columns are made too
/// @param memory   integrals known from the rows before; those of the panels at the front are kept in it. Changes
///                 no bit; may be null
std::vector<EnrichmentRows> assemble_enrichment_rows(const BodyOperator& body, const EnrichedSpace& space,
                                                     std::span<const LoadSource> sources,
                                                     const std::vector<std::size_t>& wanted,
                                                     PairMemory* memory = nullptr);

/// The columns of some sources alone, for every function of the space: 3 × 3·sources each.
std::vector<DenseMatrix> assemble_source_columns(const BodyOperator& body, const EnrichedSpace& space,
                                                 std::span<const LoadSource> sources);

/// ½ (M g_N)_a + ∫ φ_a (σ° n): what of a function's right-hand side needs no pair integrals.
Vec3 enrichment_load(const EnrichedSpace& space, const EnrichmentFunction& function, const LoadCase& load);

}  // namespace conchoid
