#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "conchoid/learn/term_basis.hpp"
#include "conchoid/learn/training.hpp"

namespace conchoid {

/// Solution of the ridge regression's normal equations (ridge.hpp).
struct RidgeFit {
  Eigen::MatrixXd beta;    ///< terms × 3
  Eigen::MatrixXd factor;  ///< L of A = LLᵀ, lower triangle
  Vec3 residual;           ///< s, modes I, II, III
};

RidgeFit fit_ridge(const TrainingData& data, const TermBasis& basis, double lambda);

/// The λ whose fits predict left-out runs best. @param run  per row of the data, the run it comes from
double choose_lambda(const TrainingData& data, const TermBasis& basis, const std::vector<std::int32_t>& run);

}  // namespace conchoid
