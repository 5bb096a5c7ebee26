#include <algorithm>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

constexpr int lanes = 4;
constexpr int max_points = 36;

/// The rule's points on one panel as arrays, filled up to a multiple of the lanes with points of weight 0.
struct PointArrays {
  int count = 0;
  alignas(32) double x[max_points], y[max_points], z[max_points], weight[max_points];
  alignas(32) double l0[max_points], l1[max_points], l2[max_points];
};

void place_points(const Panel& panel, const TriangleRule& rule, PointArrays& out) {
  const int n = static_cast<int>(rule.points.size());
  out.count = (n + lanes - 1) / lanes * lanes;
  for (int i = 0; i < out.count; ++i) {
    const RulePoint& p = rule.points[std::min(i, n - 1)];
    const Vec3 q = rule_point(panel.x, p);
    out.x[i] = q.x();
    out.y[i] = q.y();
    out.z[i] = q.z();
    out.weight[i] = i < n ? p.weight * panel.area : 0.0;
    out.l0[i] = p.l0;
    out.l1[i] = p.l1;
    out.l2[i] = p.l2;
  }
}

double sum_lanes(const double* s) {
  return (s[0] + s[1]) + (s[2] + s[3]);
}

}  // namespace

FarDegrees far_degrees(const Panel& x, const Panel& y, double tolerance) {
  const double distance = (x.center - y.center).norm();
  return {far_degree(x.radius, distance - y.radius, tolerance),
          far_degree(y.radius, distance - x.radius, tolerance)};
}

Family far_single_layer(const Panel& panel_x, const Panel& panel_y, FarDegrees degrees) {
  PointArrays py;
  place_points(panel_y, triangle_rule(degrees.y), py);
  alignas(32) double sum[7][lanes] = {};
  for (const RulePoint& rx : triangle_rule(degrees.x).points) {
    const Vec3 x = rule_point(panel_x.x, rx);
    const double x0 = x.x(), x1 = x.y(), x2 = x.z(), wx = rx.weight * panel_x.area;
    for (int j = 0; j < py.count; j += lanes) {
      for (int l = 0; l < lanes; ++l) {
        const double r0 = x0 - py.x[j + l], r1 = x1 - py.y[j + l], r2 = x2 - py.z[j + l];
        const double square = r0 * r0 + r1 * r1 + r2 * r2;
        const double v = wx * py.weight[j + l] / std::sqrt(square);
        const double c = v / square;
        const double c0 = c * r0, c1 = c * r1, c2 = c * r2;
        sum[0][l] += v;
        sum[1][l] += c0 * r0;
        sum[2][l] += c1 * r1;
        sum[3][l] += c2 * r2;
        sum[4][l] += c1 * r2;
        sum[5][l] += c0 * r2;
        sum[6][l] += c0 * r1;
      }
    }
  }
  Family result;
  for (int i = 0; i < 7; ++i)
    result[i] = sum_lanes(sum[i]);
  return result;
}

Vec3 far_double_layer(const Panel& panel_x, const Panel& panel_y, FarDegrees degrees) {
  PointArrays py;
  place_points(panel_y, triangle_rule(degrees.y), py);
  const double n0 = panel_y.normal.x(), n1 = panel_y.normal.y(), n2 = panel_y.normal.z();
  const Vec3& corner = panel_y.x[0];
  alignas(32) double sum[3][lanes] = {};
  for (const RulePoint& rx : triangle_rule(degrees.x).points) {
    const Vec3 x = rule_point(panel_x.x, rx);
    const double x0 = x.x(), x1 = x.y(), x2 = x.z();
    const double height = n0 * (x0 - corner.x()) + n1 * (x1 - corner.y()) + n2 * (x2 - corner.z());
    const double wx = rx.weight * panel_x.area * height;
    for (int j = 0; j < py.count; j += lanes) {
      for (int l = 0; l < lanes; ++l) {
        const double r0 = x0 - py.x[j + l], r1 = x1 - py.y[j + l], r2 = x2 - py.z[j + l];
        const double square = r0 * r0 + r1 * r1 + r2 * r2;
        const double k = wx * py.weight[j + l] / (square * std::sqrt(square));
        sum[0][l] += k * py.l0[j + l];
        sum[1][l] += k * py.l1[j + l];
        sum[2][l] += k * py.l2[j + l];
      }
    }
  }
  return {sum_lanes(sum[0]), sum_lanes(sum[1]), sum_lanes(sum[2])};
}

}  // namespace conchoid
