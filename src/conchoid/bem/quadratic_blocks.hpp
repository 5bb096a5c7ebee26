#pragma once

#include <Eigen/Core>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/quadrature/polynomial_pairs.hpp"

namespace conchoid {

/// Galerkin blocks of a pair of panels with quadratic displacements and linear tractions: (B3)–(B5) with the
/// surface curls of quadratic functions, which are linear,
///   c(φ_k) = Σ_a c_ka N_a ,   φ_k = N_k (2 N_k − 1): c_ka = (4 δ_ka − 1) c_k ,   φ = 4 N_j N_k: 4 (N_j c_k + N_k c_j).
///                                                                                   docs/theory.md (B10)
class QuadraticBlocks {
 public:
  using Curls = std::array<Vec3, 3>;  ///< of a panel's corner functions
  using Displacements = Eigen::Matrix<double, 18, 18>;
  using Mixed = Eigen::Matrix<double, 9, 18>;
  using Tractions = Eigen::Matrix<double, 9, 9>;

  QuadraticBlocks(const LinearSingleLayerPair& pair, const ElasticConstants& m);

  Tractions single_layer() const;                                                         ///< V
  Displacements hypersingular(const Curls& test, const Curls& trial) const;               ///< D
  Mixed double_layer(const Curls& trial, const QuadraticDoubleLayerPair& laplace) const;  ///< K

 private:
  std::vector<PairBlocks> blocks_;  // 3 a + b
};

/// ∫ N_a φ_k over a panel: rows a, columns k.
Eigen::Matrix<double, 3, 6> quadratic_mass(double area);

}  // namespace conchoid
