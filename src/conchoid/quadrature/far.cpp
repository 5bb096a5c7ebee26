#include <algorithm>
#include <array>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

// The point loops are compiled once more for processors with AVX2. They hold no call that is shared with
// other code, and contraction is off, so every processor computes the same bits. Sanitizers start too late
// for the choice at load time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CONCHOID_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CONCHOID_WIDE_CLONES
#endif

namespace conchoid {

namespace {

constexpr int lanes = 4;
constexpr int max_points = 36;
constexpr int max_degree = 12;

/// A rule's points as arrays, filled up to a multiple of the lanes with points of weight 0.
struct RuleArrays {
  int count = 0, padded = 0;
  alignas(32) double l[3][max_points];
  alignas(32) double weight[max_points];
};

const RuleArrays& rule_arrays(int degree) {
  static const auto table = [] {
    std::array<RuleArrays, max_degree + 1> all{};
    for (const TriangleRule& rule : triangle_rules()) {
      RuleArrays& to = all[static_cast<std::size_t>(rule.degree)];
      to.count = static_cast<int>(rule.points.size());
      to.padded = (to.count + lanes - 1) / lanes * lanes;
      for (int i = 0; i < to.padded; ++i) {
        const RulePoint& p = rule.points[static_cast<std::size_t>(std::min(i, to.count - 1))];
        to.l[0][i] = p.l0;
        to.l[1][i] = p.l1;
        to.l[2][i] = p.l2;
        to.weight[i] = i < to.count ? p.weight : 0.0;
      }
    }
    return all;
  }();
  return table[static_cast<std::size_t>(degree)];
}

/// The rule's points on one panel, one array per coordinate.
struct PlacedPoints {
  const RuleArrays* rule;
  alignas(32) double at[3][max_points];

  PlacedPoints(const Triangle& t, int degree) : rule(&rule_arrays(degree)) {
    for (int k = 0; k < 3; ++k) {
      const double a = t[0][k], b = t[1][k], c = t[2][k];
      for (int i = 0; i < rule->padded; ++i)
        at[k][i] = rule->l[0][i] * a + rule->l[1][i] * b + rule->l[2][i] * c;
    }
  }
};

/// Four numbers at a time; the compiler makes of it what the processor has.
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double)), may_alias));

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

double sum_lanes(const double (&s)[lanes]) {
  return (s[0] + s[1]) + (s[2] + s[3]);
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
