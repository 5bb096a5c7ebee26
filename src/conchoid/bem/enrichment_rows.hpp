#pragma once

#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/enrichment.hpp"

namespace conchoid {

/// The three rows that one vector-valued enrichment function adds to the system (test function f e_p, p = 0, 1, 2).
struct EnrichmentRows {
  DenseMatrix D_body;      ///< 3 × 3·displacement unknowns: against the body's nodes
  DenseMatrix D_enriched;  ///< 3 × 3·functions: against all enrichment functions
  DenseMatrix K;           ///< 3·traction unknowns × 3: its column of K
  /// ½M g_N − Kᵀ g_N − D g_D + ambient stress on the crack                               docs/theory.md (B7)
  Vec3 load = Vec3::Zero();
};

/// What the rows are made against.
struct EnrichmentProblem {
  const BodyOperator& body;
  const LoadCase& load;
};

/// Rows of the functions listed in `wanted` (indices into space.functions), in that order.
std::vector<EnrichmentRows> assemble_enrichment_rows(const EnrichmentProblem& problem,
                                                     const EnrichedSpace& space,
                                                     const std::vector<std::size_t>& wanted);

/// Their `load` alone, for another load case than the one their rows were made for.
std::vector<Vec3> assemble_enrichment_loads(const EnrichmentProblem& problem, const EnrichedSpace& space);

}  // namespace conchoid
