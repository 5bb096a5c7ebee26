#include <algorithm>
#include <array>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_points.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

/// Corners of a triangle, by coordinate.
struct Coordinates {
  double of[3][3];
  explicit Coordinates(const Triangle& t) {
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i)
        of[k][i] = t[i][k];
  }
};

/// The rule's points on it.
CONCHOID_INTO_CLONES void place(const Coordinates& t, const RuleArrays& rule, double (&at)[3][max_points]) {
  const auto *l0 = reinterpret_cast<const Lanes*>(rule.l[0]), *l1 = reinterpret_cast<const Lanes*>(rule.l[1]),
             *l2 = reinterpret_cast<const Lanes*>(rule.l[2]);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < rule.padded / lanes; ++j)
      reinterpret_cast<Lanes*>(at[k])[j] = l0[j] * t.of[k][0] + l1[j] * t.of[k][1] + l2[j] * t.of[k][2];
}

CONCHOID_INTO_CLONES void add_lanes(const Lanes& s, double& result) {
  result = (s[0] + s[1]) + (s[2] + s[3]);
}

CONCHOID_WIDE_CLONES void sum_single_layer(const Coordinates& x, const RuleArrays& x_rule,
                                           const Coordinates& y, const RuleArrays& y_rule,
                                           double (&result)[7]) {
  alignas(32) double x_at[3][max_points], y_at[3][max_points];
  place(x, x_rule, x_at);
  place(y, y_rule, y_at);
  const auto *y0 = reinterpret_cast<const Lanes*>(y_at[0]), *y1 = reinterpret_cast<const Lanes*>(y_at[1]),
             *y2 = reinterpret_cast<const Lanes*>(y_at[2]),
             *wy = reinterpret_cast<const Lanes*>(y_rule.weight);
  Lanes s0{}, s1{}, s2{}, s3{}, s4{}, s5{}, s6{};
  const int blocks = y_rule.padded / lanes;
  for (int i = 0; i < x_rule.count; ++i) {
    const double x0 = x_at[0][i], x1 = x_at[1][i], x2 = x_at[2][i], wx = x_rule.weight[i];
    for (int j = 0; j < blocks; ++j) {
      const Lanes r0 = x0 - y0[j], r1 = x1 - y1[j], r2 = x2 - y2[j];
      Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
      const Lanes inverse_square = 1 / r;  // beside the root, not after it
      take_root(r);
      const Lanes v = wx * wy[j] * (r * inverse_square);
      const Lanes c = v * inverse_square;
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
  const Lanes* sums[7] = {&s0, &s1, &s2, &s3, &s4, &s5, &s6};
  for (int k = 0; k < 7; ++k)
    add_lanes(*sums[k], result[k]);
}

/// Heights of the points of X above y0, the corner 0 of Y, times their weights.
CONCHOID_INTO_CLONES void weigh_heights(const double (&x_at)[3][max_points], const RuleArrays& x_rule,
                                        const Coordinates& y, const double (&normal)[3],
                                        double (&height)[max_points]) {
  for (int j = 0; j < x_rule.padded / lanes; ++j)
    reinterpret_cast<Lanes*>(height)[j] =
        reinterpret_cast<const Lanes*>(x_rule.weight)[j] *
        (normal[0] * (reinterpret_cast<const Lanes*>(x_at[0])[j] - y.of[0][0]) +
         normal[1] * (reinterpret_cast<const Lanes*>(x_at[1])[j] - y.of[1][0]) +
         normal[2] * (reinterpret_cast<const Lanes*>(x_at[2])[j] - y.of[2][0]));
}

/// w/R³ between one point and block j of the others.
CONCHOID_INTO_CLONES void weigh_cubes(const double (&point)[3], const double (&at)[3][max_points], int j,
                                      const Lanes& w, Lanes& result) {
  const Lanes r0 = point[0] - reinterpret_cast<const Lanes*>(at[0])[j],
              r1 = point[1] - reinterpret_cast<const Lanes*>(at[1])[j],
              r2 = point[2] - reinterpret_cast<const Lanes*>(at[2])[j];
  Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
  const Lanes inverse_square = 1 / r;
  take_root(r);
  result = w * r * (inverse_square * inverse_square);
}

/// The points of Y side by side.
CONCHOID_WIDE_CLONES void sum_double_layer_along_y(const Coordinates& x, const RuleArrays& x_rule,
                                                   const Coordinates& y, const RuleArrays& y_rule,
                                                   const double (&normal)[3], double (&result)[3]) {
  alignas(32) double x_at[3][max_points], y_at[3][max_points], height[max_points];
  place(x, x_rule, x_at);
  place(y, y_rule, y_at);
  weigh_heights(x_at, x_rule, y, normal, height);
  const auto *l0 = reinterpret_cast<const Lanes*>(y_rule.l[0]),
             *l1 = reinterpret_cast<const Lanes*>(y_rule.l[1]),
             *l2 = reinterpret_cast<const Lanes*>(y_rule.l[2]),
             *wy = reinterpret_cast<const Lanes*>(y_rule.weight);
  Lanes s0{}, s1{}, s2{};
  const int blocks = y_rule.padded / lanes;
  for (int i = 0; i < x_rule.count; ++i) {
    const double point[3] = {x_at[0][i], x_at[1][i], x_at[2][i]};
    for (int j = 0; j < blocks; ++j) {
      Lanes k;
      weigh_cubes(point, y_at, j, height[i] * wy[j], k);
      s0 += k * l0[j];
      s1 += k * l1[j];
      s2 += k * l2[j];
    }
  }
  add_lanes(s0, result[0]);
  add_lanes(s1, result[1]);
  add_lanes(s2, result[2]);
}

/// The points of X side by side.
CONCHOID_WIDE_CLONES void sum_double_layer_along_x(const Coordinates& x, const RuleArrays& x_rule,
                                                   const Coordinates& y, const RuleArrays& y_rule,
                                                   const double (&normal)[3], double (&result)[3]) {
  alignas(32) double x_at[3][max_points], y_at[3][max_points], height[max_points];
  place(x, x_rule, x_at);
  place(y, y_rule, y_at);
  weigh_heights(x_at, x_rule, y, normal, height);
  Lanes s0{}, s1{}, s2{};
  const int blocks = x_rule.padded / lanes;
  for (int i = 0; i < y_rule.count; ++i) {
    const double point[3] = {y_at[0][i], y_at[1][i], y_at[2][i]};
    Lanes sum{};
    for (int j = 0; j < blocks; ++j) {
      Lanes k;
      weigh_cubes(point, x_at, j, reinterpret_cast<const Lanes*>(height)[j], k);
      sum += k;
    }
    const Lanes w = y_rule.weight[i] * sum;
    s0 += y_rule.l[0][i] * w;
    s1 += y_rule.l[1][i] * w;
    s2 += y_rule.l[2][i] * w;
  }
  add_lanes(s0, result[0]);
  add_lanes(s1, result[1]);
  add_lanes(s2, result[2]);
}

/// Whether fewer lanes are empty where the points of `a` are side by side, not those of `b`.
bool fills_lanes(const RuleArrays& a, const RuleArrays& b) {
  return b.count * a.padded < a.count * b.padded;
}

}  // namespace

FarDegrees far_degrees(const FarLimits& limits, Layer layer, const Panel& x, const Panel& y) {
  const double distance = (x.center - y.center).norm();
  return {limits.degree(layer, x.radius, distance - y.radius),
          limits.degree(layer, y.radius, distance - x.radius)};
}

Family far_single_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  double sum[7];
  const RuleArrays &x_rule = rule_arrays(degrees.x), &y_rule = rule_arrays(degrees.y);
  if (fills_lanes(x_rule, y_rule))
    sum_single_layer(Coordinates(y.x), y_rule, Coordinates(x.x), x_rule, sum);
  else
    sum_single_layer(Coordinates(x.x), x_rule, Coordinates(y.x), y_rule, sum);
  return x.area * y.area * Eigen::Map<const Family>(sum);
}

Vec3 far_double_layer(const Panel& x, const Panel& y, FarDegrees degrees) {
  double sum[3];
  const double normal[3] = {y.normal[0], y.normal[1], y.normal[2]};
  const RuleArrays &x_rule = rule_arrays(degrees.x), &y_rule = rule_arrays(degrees.y);
  if (fills_lanes(x_rule, y_rule))
    sum_double_layer_along_x(Coordinates(x.x), x_rule, Coordinates(y.x), y_rule, normal, sum);
  else
    sum_double_layer_along_y(Coordinates(x.x), x_rule, Coordinates(y.x), y_rule, normal, sum);
  return x.area * y.area * Eigen::Map<const Vec3>(sum);
}

}  // namespace conchoid
