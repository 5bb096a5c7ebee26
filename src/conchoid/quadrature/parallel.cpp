#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/point_quadrature.hpp"

namespace conchoid {

namespace {

double perimeter(const PanelPotential& panel) {
  return panel.edge_length(0) + panel.edge_length(1) + panel.edge_length(2);
}

/// Of the corner function N_j.
Vec3 gradient(const PanelPotential& panel, int j) {
  const int e = (j + 1) % 3;
  return -(panel.edge_length(e) / panel.double_area()) * panel.edge_normal(e);
}

/// Σ_e ∫_e f over the edges of X.
/// @param f  f(outward normal of the edge, points, values)
/// @param add  add(outward normal of the edge, integral)
template <int N, class F, class Add>
void over_contour(const ParallelPair& pair, double allowed, const F& f, const Add& add) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = pair.x.corner(i), &b = pair.x.corner((i + 1) % 3), &m = pair.x.edge_normal(i);
    const double length = pair.x.edge_length(i);
    const auto on_edge = [&](const Parameters& s, PointValues<N>& v) { f(m, points_between(a, b, s), v); };
    const Eigen::Matrix<double, N, 1> integral =
        integrate_unit_segment<N>(on_edge, steep_places(a, b, pair.y), allowed / length);
    add(m, Eigen::Matrix<double, N, 1>(length * integral));
  }
}

}  // namespace

double parallel_loss(const ParallelPair& pair) {
  const double areas = pair.x.double_area() * pair.y.double_area() / 4;
  return perimeter(pair.x) * perimeter(pair.y) * pair.diameter * pair.diameter / areas;
}

Family parallel_single_layer(const ParallelPair& pair, double tolerance) {
  const PointPotentials around(pair.y);
  const Mat3& axes = around.axes();
  const double areas = pair.x.double_area() * pair.y.double_area() / 4;
  const Vec3 &first = pair.x.corner(0), &second = pair.x.corner(1), &third = pair.x.corner(2);
  double h = (pair.y.height(first) + pair.y.height(second) + pair.y.height(third)) / 3;
  if (std::abs(h) <= pair.y.noise()) h = 0;
  // Own axes of Y: a, |h| b, h V.
  const auto f = [&](const Vec3&, const Points& points, PointValues<5>& v) {
    PointValues<6> of;
    around.contour(points, pair.diameter, of);
    for (int i = 0; i < Points::most; ++i) {
      v.of[0][i] = of.of[0][i];
      v.of[1][i] = of.of[1][i];
      v.of[2][i] = std::abs(h) * of.of[2][i];
      v.of[3][i] = std::abs(h) * of.of[3][i];
      v.of[4][i] = h * of.of[4][i];
    }
  };
  Family sum = Family::Zero();
  const auto add = [&](const Vec3& normal, const Eigen::Matrix<double, 5, 1>& v) {
    const double m0 = axes.col(0).dot(normal), m1 = axes.col(1).dot(normal);
    const double of_log = m0 * v[2] + m1 * v[3];
    sum[0] -= m0 * v[0] + m1 * v[1] - of_log;
    sum[1] += m0 * v[0];
    sum[2] += m1 * v[1];
    sum[3] -= of_log;
    sum[4] -= m1 * v[4];
    sum[5] -= m0 * v[4];
    sum[6] += (m0 * v[1] + m1 * v[0]) / 2;
  };
  over_contour<5>(pair, tolerance * areas / (8 * pair.diameter), f, add);
  sum[1] += sum[0];
  sum[2] += sum[0];
  return around.in_space(sum);
}

Vec3 parallel_double_layer(const ParallelPair& pair, double tolerance) {
  const PointPotentials around(pair.y);
  const Mat3& axes = around.axes();
  const double areas = pair.x.double_area() * pair.y.double_area() / 4;
  const double h = pair.y.height(pair.x.corner(0));
  const std::array<Vec3, 3> gradients = {gradient(pair.y, 0), gradient(pair.y, 1), gradient(pair.y, 2)};
  const auto f = [&](const Vec3& m, const Points& points, PointValues<3>& v) {
    PointValues<6> of;
    around.contour(points, pair.diameter, of);
    const double m0 = axes.col(0).dot(m), m1 = axes.col(1).dot(m);
    const Vec3 along(gradients[0].dot(m), gradients[1].dot(m), gradients[2].dot(m));
    for (int i = 0; i < Points::most; ++i) {
      const Vec3 N = pair.y.corner_functions({points.at[0][i], points.at[1][i], points.at[2][i]});
      const double slope = -(m0 * of.of[2][i] + m1 * of.of[3][i]);
      const double rest = std::abs(h) * of.of[4][i] - of.of[5][i];
      for (int k = 0; k < 3; ++k)
        v.of[k][i] = N[k] * slope + along[k] * rest;
    }
  };
  Vec3 sum = Vec3::Zero();
  const double allowed = tolerance * areas / (4 * pair.diameter * pair.diameter);
  over_contour<3>(pair, allowed, f, [&](const Vec3&, const Vec3& v) { sum += v; });
  return h < 0 ? Vec3(-sum) : sum;
}

}  // namespace conchoid
