#pragma once

#include <Eigen/Core>
#include <array>

#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// ∫_X∫_Y N_a(x) N_b(y) of 1/R and r rᵀ/R³, N the corner functions of each panel, at 3 a + b.
///                                                                                   docs/theory.md (Q6)
using LinearSingleLayerPair = std::array<SingleLayerPair, 9>;

/// ∫_{x∈X} ∫_{y∈Y} N_a(x) φ_k(y) ∂/∂n_y (1/R): row a, column k. φ are the quadratic functions of Y: of its corners 0, 1, 2,
/// then of the middles of its edges 01, 12, 20. Principal value: 0 when X and Y are coplanar.
using QuadraticDoubleLayerPair = Eigen::Matrix<double, 3, 6>;

/// The quadratic functions at barycentric coordinates l, in that order.
Eigen::Matrix<double, 6, 1> quadratic_functions(const Vec3& l);

/// Integrals over pairs of flat panels with polynomial densities. Panels that share a vertex go by (Q5), term by
/// term of the polynomials about it; panels nearby by cells on one and closed forms of the other; far ones by Gauss
/// points on both. Panels of a closed surface that does not cross itself are meant: near ones that cross without
/// a shared vertex lose digits.
class PolynomialPairIntegrator {
 public:
  /// @param tolerance  wanted error of an integral, relative to that of density 1; 1e-3 … 1e-11
  explicit PolynomialPairIntegrator(double tolerance = 1e-6);

  LinearSingleLayerPair single_layer(const Panel& x, const Panel& y) const;
  QuadraticDoubleLayerPair double_layer(const Panel& x, const Panel& y) const;

 private:
  double tolerance_;
};

}  // namespace conchoid
