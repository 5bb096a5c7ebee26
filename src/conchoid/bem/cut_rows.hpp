#pragma once

#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/cut_space.hpp"

namespace conchoid {

/// The three rows that one vector-valued cut function adds to the system (test function f e_p, p = 0, 1, 2).
struct CutRows {
  DenseMatrix D_body;  ///< 3 × 3·displacement unknowns: against the body's nodes
  DenseMatrix D_cut;   ///< 3 × 3·functions: against all cut functions
  DenseMatrix K;       ///< 3·traction unknowns × 3: its column of K
  Vec3 load =
      Vec3::Zero();  ///< ½M g_N − Kᵀ g_N − D g_D + ambient stress on the crack        docs/theory.md (B7)
};

/// What the rows are made against.
struct CutProblem {
  const BodyOperator& body;
  const LoadCase& load;
};

/// Rows of the functions listed in `wanted` (indices into space.functions), in that order.
std::vector<CutRows> assemble_cut_rows(const CutProblem& problem, const CutSpace& space,
                                       const std::vector<std::size_t>& wanted);

/// Their `load` alone, for another load case than the one their rows were made for.
std::vector<Vec3> assemble_cut_loads(const CutProblem& problem, const CutSpace& space);

}  // namespace conchoid
