#include <cmath>

#include "conchoid/quadrature/far_points.hpp"
#include "conchoid/quadrature/polynomial_cases.hpp"

namespace conchoid {

namespace {

constexpr int family = 7;

/// Of one point x, over the points of Y: the family times the weights of Y, times 1, N_1, N_2.
CONCHOID_WIDE_CLONES void sum_linear(double x0, double x1, double x2, const PlacedPoints& y,
                                     double (&result)[3][family][lanes]) {
  const auto *y0 = reinterpret_cast<const Lanes*>(y.at[0]), *y1 = reinterpret_cast<const Lanes*>(y.at[1]),
             *y2 = reinterpret_cast<const Lanes*>(y.at[2]),
             *wy = reinterpret_cast<const Lanes*>(y.rule->weight);
  const auto *n1 = reinterpret_cast<const Lanes*>(y.rule->l[1]),
             *n2 = reinterpret_cast<const Lanes*>(y.rule->l[2]);
  Lanes s[3][family] = {};
  const int blocks = y.rule->padded / lanes;
  for (int j = 0; j < blocks; ++j) {
    const Lanes r0 = x0 - y0[j], r1 = x1 - y1[j], r2 = x2 - y2[j];
    Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
    for (int l = 0; l < lanes; ++l)
      r[l] = std::sqrt(r[l]);
    const Lanes inverse = 1 / r;
    const Lanes v = wy[j] * inverse;
    const Lanes c = v * (inverse * inverse);
    const Lanes c0 = c * r0, c1 = c * r1, c2 = c * r2;
    const Lanes k[family] = {v, c0 * r0, c1 * r1, c2 * r2, c1 * r2, c0 * r2, c0 * r1};
    for (int i = 0; i < family; ++i) {
      s[0][i] += k[i];
      s[1][i] += n1[j] * k[i];
      s[2][i] += n2[j] * k[i];
    }
  }
  for (int b = 0; b < 3; ++b)
    for (int i = 0; i < family; ++i)
      for (int l = 0; l < lanes; ++l)
        result[b][i][l] = s[b][i][l];
}

/// Of one point x, over the points of Y: R⁻³ times the weights of Y and the quadratic monomials.
CONCHOID_WIDE_CLONES void sum_quadratic(double x0, double x1, double x2, const PlacedPoints& y,
                                        double (&result)[6][lanes]) {
  const auto *y0 = reinterpret_cast<const Lanes*>(y.at[0]), *y1 = reinterpret_cast<const Lanes*>(y.at[1]),
             *y2 = reinterpret_cast<const Lanes*>(y.at[2]),
             *wy = reinterpret_cast<const Lanes*>(y.rule->weight);
  const auto *n1 = reinterpret_cast<const Lanes*>(y.rule->l[1]),
             *n2 = reinterpret_cast<const Lanes*>(y.rule->l[2]);
  Lanes s[6] = {};
  const int blocks = y.rule->padded / lanes;
  for (int j = 0; j < blocks; ++j) {
    const Lanes r0 = x0 - y0[j], r1 = x1 - y1[j], r2 = x2 - y2[j];
    Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
    for (int l = 0; l < lanes; ++l)
      r[l] = std::sqrt(r[l]);
    const Lanes inverse = 1 / r;
    const Lanes k = wy[j] * (inverse * inverse) * inverse;
    const Lanes k1 = k * n1[j], k2 = k * n2[j];
    s[0] += k;
    s[1] += k1;
    s[2] += k2;
    s[3] += k1 * n1[j];
    s[4] += k1 * n2[j];
    s[5] += k2 * n2[j];
  }
  for (int i = 0; i < 6; ++i)
    for (int l = 0; l < lanes; ++l)
      result[i][l] = s[i][l];
}

}  // namespace

LinearMoments far_linear_single_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  const PlacedPoints of_x(x.x, degrees.x), of_y(y.x, degrees.y);
  LinearMoments result = LinearMoments::Zero();
  alignas(32) double sum[3][family][lanes];
  for (int i = 0; i < of_x.rule->count; ++i) {
    sum_linear(of_x.at[0][i], of_x.at[1][i], of_x.at[2][i], of_y, sum);
    Eigen::Matrix<double, 7, 3> of;
    for (int b = 0; b < 3; ++b)
      for (int k = 0; k < family; ++k)
        of(k, b) = of_x.rule->weight[i] * sum_lanes(sum[b][k]);
    result.leftCols<3>() += of;
    result.middleCols<3>(3) += of_x.rule->l[1][i] * of;
    result.rightCols<3>() += of_x.rule->l[2][i] * of;
  }
  return x.area * y.area * result;
}

QuadraticMoments far_quadratic_double_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  const PlacedPoints of_x(x.x, degrees.x), of_y(y.x, degrees.y);
  QuadraticMoments result = QuadraticMoments::Zero();
  alignas(32) double sum[6][lanes];
  for (int i = 0; i < of_x.rule->count; ++i) {
    const Vec3 p(of_x.at[0][i], of_x.at[1][i], of_x.at[2][i]);
    sum_quadratic(p.x(), p.y(), p.z(), of_y, sum);
    const double height = of_x.rule->weight[i] * y.normal.dot(p - y.x[0]);
    Eigen::Matrix<double, 1, 6> of;
    for (int k = 0; k < 6; ++k)
      of[k] = height * sum_lanes(sum[k]);
    result += linear_monomials(of_x.rule->l[1][i], of_x.rule->l[2][i]) * of;
  }
  return x.area * y.area * result;
}

}  // namespace conchoid
