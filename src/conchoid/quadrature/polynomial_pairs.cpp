#include "conchoid/quadrature/polynomial_pairs.hpp"

#include "conchoid/core/error.hpp"
#include "conchoid/quadrature/polynomial_cases.hpp"

namespace conchoid {

namespace {

constexpr std::array<int, 3> as_they_are = {0, 1, 2};

/// Rows: corner functions, in terms of 1, N_1, N_2.
Mat3 corner_functions_of_monomials() {
  Mat3 m;
  m << 1, -1, -1, 0, 1, 0, 0, 0, 1;
  return m;
}

/// Rows: quadratic functions, in terms of 1, N_1, N_2, N_1², N_1 N_2, N_2².
Eigen::Matrix<double, 6, 6> quadratic_functions_of_monomials() {
  Eigen::Matrix<double, 6, 6> m;
  m << 1, -3, -3, 2, 4, 2,  //
      0, -1, 0, 2, 0, 0,    //
      0, 0, -1, 0, 0, 2,    //
      0, 4, 0, -4, -4, 0,   //
      0, 0, 0, 0, 4, 0,     //
      0, 0, 4, 0, -4, -4;
  return m;
}

SingleLayerPair to_pair(const Family& f) {
  return {f[0], {f[1], f[2], f[3], f[4], f[5], f[6]}};
}

/// @param x_corner, y_corner  which corners of the panels the monomials' corners are
LinearSingleLayerPair to_corners(const LinearMoments& moments, const std::array<int, 3>& x_corner,
                                 const std::array<int, 3>& y_corner) {
  static const Mat3 C = corner_functions_of_monomials();
  LinearSingleLayerPair pair;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      Family sum = Family::Zero();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (const double factor = C(a, i) * C(b, j); factor != 0) sum += factor * moments.col(3 * i + j);
      pair[static_cast<std::size_t>(3 * x_corner[a] + y_corner[b])] = to_pair(sum);
    }
  return pair;
}

/// Middle of the edge between two corners: 3 for 01, 4 for 12, 5 for 20.
int middle_of(int a, int b) {
  return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
}

QuadraticDoubleLayerPair to_functions(const QuadraticMoments& moments, const std::array<int, 3>& x_corner,
                                      const std::array<int, 3>& y_corner) {
  static const Mat3 C = corner_functions_of_monomials();
  static const Eigen::Matrix<double, 6, 6> Q = quadratic_functions_of_monomials();
  const QuadraticMoments turned = C * moments * Q.transpose();
  QuadraticDoubleLayerPair pair;
  for (int a = 0; a < 3; ++a)
    for (int k = 0; k < 3; ++k) {
      pair(x_corner[a], y_corner[k]) = turned(a, k);
      pair(x_corner[a], middle_of(y_corner[k], y_corner[(k + 1) % 3])) = turned(a, 3 + k);
    }
  return pair;
}

FarDegrees degrees_for(Layer layer, const Panel& x, const Panel& y, double tolerance, int density_y) {
  const double distance = (x.center - y.center).norm();
  return {far_degree(layer, x.radius, distance - y.radius, tolerance / 2, 1),
          far_degree(layer, y.radius, distance - x.radius, tolerance / 2, density_y)};
}

}  // namespace

Eigen::Matrix<double, 6, 1> quadratic_functions(const Vec3& l) {
  Eigen::Matrix<double, 6, 1> phi;
  for (int k = 0; k < 3; ++k) {
    phi[k] = l[k] * (2 * l[k] - 1);
    phi[3 + k] = 4 * l[k] * l[(k + 1) % 3];
  }
  return phi;
}

PolynomialPairIntegrator::PolynomialPairIntegrator(double tolerance) : tolerance_(tolerance) {
  if (!(tolerance >= 1e-11 && tolerance <= 1e-3))
    throw InputError("tolerance of the pair integrals must lie between 1e-11 and 1e-3");
}

LinearSingleLayerPair PolynomialPairIntegrator::single_layer(const Panel& x, const Panel& y) const {
  if (shared_corners(x, y).count > 0) {
    const TouchingPair pair = touching_pair(x, y);
    return to_corners(touching_linear_single_layer(pair, tolerance_), pair.x_corner, pair.y_corner);
  }
  const FarDegrees degrees = degrees_for(Layer::single, x, y, tolerance_, 1);
  return to_corners(
      degrees.enough() ? far_linear_single_layer(x, y, degrees) : near_linear_single_layer(x, y, tolerance_),
      as_they_are, as_they_are);
}

QuadraticDoubleLayerPair PolynomialPairIntegrator::double_layer(const Panel& x, const Panel& y) const {
  const int shared = shared_corners(x, y).count;
  if (shared == 3) return QuadraticDoubleLayerPair::Zero();
  if (shared > 0) {
    const TouchingPair pair = touching_pair(x, y);
    return to_functions(touching_quadratic_double_layer(pair, tolerance_), pair.x_corner, pair.y_corner);
  }
  const FarDegrees degrees = degrees_for(Layer::dbl, x, y, tolerance_, 2);
  return to_functions(degrees.enough() ? far_quadratic_double_layer(x, y, degrees)
                                       : near_quadratic_double_layer(x, y, tolerance_),
                      as_they_are, as_they_are);
}

}  // namespace conchoid
