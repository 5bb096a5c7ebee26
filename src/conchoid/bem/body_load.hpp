#pragma once

#include <vector>

#include "conchoid/bem/body_blocks.hpp"
#include "conchoid/bem/load_case.hpp"

namespace conchoid {

/// Right-hand side of the uncracked body:
///   f_D = −V g_N + (½M + K) g_D      per unknown traction
///   f_N = (½M − Kᵀ) g_N − D g_D      per unknown displacement                          docs/theory.md (B1)
/// g_N and g_D are the prescribed traction and displacement, M the mass matrix between the two.
struct BodyLoad {
  std::vector<double> f_D, f_N;
};

/// Integrates over the pairs that a prescribed value touches, and over no others.
BodyLoad assemble_load(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                       const ElasticConstants& m, const BodyBlocks& body, const PairIntegrator& integrator,
                       const LoadCase& load);

}  // namespace conchoid
