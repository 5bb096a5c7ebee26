#include <algorithm>
#include <array>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_points.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

CONCHOID_WIDE_CLONES void sum_single_layer(const PlacedPoints& x, const PlacedPoints& y,
                                           double (&result)[7][lanes]) {
  const auto *y0 = reinterpret_cast<const Lanes*>(y.at[0]), *y1 = reinterpret_cast<const Lanes*>(y.at[1]),
             *y2 = reinterpret_cast<const Lanes*>(y.at[2]),
             *wy = reinterpret_cast<const Lanes*>(y.rule->weight);
  Lanes s0{}, s1{}, s2{}, s3{}, s4{}, s5{}, s6{};
  const int blocks = y.rule->padded / lanes;
  for (int i = 0; i < x.rule->count; ++i) {
    const double x0 = x.at[0][i], x1 = x.at[1][i], x2 = x.at[2][i], wx = x.rule->weight[i];
    for (int j = 0; j < blocks; ++j) {
      const Lanes r0 = x0 - y0[j], r1 = x1 - y1[j], r2 = x2 - y2[j];
      Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
      for (int l = 0; l < lanes; ++l)
        r[l] = std::sqrt(r[l]);
      const Lanes inverse = 1 / r;
      const Lanes v = wx * wy[j] * inverse;
      const Lanes c = v * (inverse * inverse);
      const Lanes c0 = c * r0, c1 = c * r1, c2 = c * r2;
      s0 += v;
      s1 += c0 * r0;
      s2 += c1 * r1;
      s3 += c2 * r2;
      s4 += c1 * r2;
      s5 += c0 * r2;
      s6 += c0 * r1;
    }
  }
  for (int l = 0; l < lanes; ++l) {
    result[0][l] = s0[l];
    result[1][l] = s1[l];
    result[2][l] = s2[l];
    result[3][l] = s3[l];
    result[4][l] = s4[l];
    result[5][l] = s5[l];
    result[6][l] = s6[l];
  }
}

/// @param height  of every point of X above the plane of Y, times the weight
CONCHOID_WIDE_CLONES void sum_double_layer(const PlacedPoints& x, const double* height, const PlacedPoints& y,
                                           double (&result)[3][lanes]) {
  const auto *y0 = reinterpret_cast<const Lanes*>(y.at[0]), *y1 = reinterpret_cast<const Lanes*>(y.at[1]),
             *y2 = reinterpret_cast<const Lanes*>(y.at[2]),
             *wy = reinterpret_cast<const Lanes*>(y.rule->weight);
  const auto *l0 = reinterpret_cast<const Lanes*>(y.rule->l[0]),
             *l1 = reinterpret_cast<const Lanes*>(y.rule->l[1]),
             *l2 = reinterpret_cast<const Lanes*>(y.rule->l[2]);
  Lanes s0{}, s1{}, s2{};
  const int blocks = y.rule->padded / lanes;
  for (int i = 0; i < x.rule->count; ++i) {
    const double x0 = x.at[0][i], x1 = x.at[1][i], x2 = x.at[2][i], h = height[i];
    for (int j = 0; j < blocks; ++j) {
      const Lanes r0 = x0 - y0[j], r1 = x1 - y1[j], r2 = x2 - y2[j];
      Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
      for (int l = 0; l < lanes; ++l)
        r[l] = std::sqrt(r[l]);
      const Lanes inverse = 1 / r;
      const Lanes k = h * wy[j] * (inverse * inverse) * inverse;
      s0 += k * l0[j];
      s1 += k * l1[j];
      s2 += k * l2[j];
    }
  }
  for (int l = 0; l < lanes; ++l) {
    result[0][l] = s0[l];
    result[1][l] = s1[l];
    result[2][l] = s2[l];
  }
}

}  // namespace

FarDegrees far_degrees(Layer layer, const Panel& x, const Panel& y, double tolerance) {
  const double distance = (x.center - y.center).norm();
  return {far_degree(layer, x.radius, distance - y.radius, tolerance / 2),
          far_degree(layer, y.radius, distance - x.radius, tolerance / 2)};
}

Family far_single_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  alignas(32) double sum[7][lanes] = {};
  sum_single_layer(PlacedPoints(x.x, degrees.x), PlacedPoints(y.x, degrees.y), sum);
  const double areas = x.area * y.area;
  Family result;
  for (int i = 0; i < 7; ++i)
    result[i] = areas * sum_lanes(sum[i]);
  return result;
}

Vec3 far_double_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  const PlacedPoints of_x(x.x, degrees.x), of_y(y.x, degrees.y);
  std::array<double, max_points> height;
  for (int i = 0; i < of_x.rule->count; ++i) {
    const Vec3 above(of_x.at[0][i] - y.x[0].x(), of_x.at[1][i] - y.x[0].y(), of_x.at[2][i] - y.x[0].z());
    height[static_cast<std::size_t>(i)] = of_x.rule->weight[i] * y.normal.dot(above);
  }
  alignas(32) double sum[3][lanes] = {};
  sum_double_layer(of_x, height.data(), of_y, sum);
  const double areas = x.area * y.area;
  return {areas * sum_lanes(sum[0]), areas * sum_lanes(sum[1]), areas * sum_lanes(sum[2])};
}

}  // namespace conchoid
