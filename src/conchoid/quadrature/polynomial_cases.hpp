#pragma once

#include <Eigen/Core>

#include "conchoid/quadrature/cases.hpp"

/// The cases of pairs with polynomial densities, one file each. Densities are monomials in the corner functions of
/// corners 1 and 2: 1, N_1, N_2 (linear), then N_1², N_1 N_2, N_2² (quadratic).
namespace conchoid {

/// Column 3 a + b: density a on X, b on Y; rows as Family.
using LinearMoments = Eigen::Matrix<double, 7, 9>;
/// Row a: linear density on X; column k: quadratic density on Y.
using QuadraticMoments = Eigen::Matrix<double, 3, 6>;

LinearMoments touching_linear_single_layer(const TouchingPair& pair, double tolerance);
QuadraticMoments touching_quadratic_double_layer(const TouchingPair& pair, double tolerance);

LinearMoments near_linear_single_layer(const Panel& x, const Panel& y, double tolerance);
QuadraticMoments near_quadratic_double_layer(const Panel& x, const Panel& y, double tolerance);

LinearMoments far_linear_single_layer(const Panel& x, const Panel& y, FarDegrees degrees);
QuadraticMoments far_quadratic_double_layer(const Panel& x, const Panel& y, FarDegrees degrees);

inline Vec3 linear_monomials(double n1, double n2) {
  return {1, n1, n2};
}
inline Eigen::Matrix<double, 6, 1> quadratic_monomials(double n1, double n2) {
  Eigen::Matrix<double, 6, 1> m;
  m << 1, n1, n2, n1 * n1, n1 * n2, n2 * n2;
  return m;
}

}  // namespace conchoid
