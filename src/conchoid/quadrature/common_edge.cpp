#include <algorithm>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/segment_quadrature.hpp"

namespace conchoid {

namespace {

/// Parameter on p0p1 of its point closest to the line through q0 and q1: where an integral over that line may
/// peak.
double closest_parameter(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 u = p1 - p0, v = q1 - q0, w = q0 - p0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double det = uu * vv - uv * uv;
  return det > 0 ? (u.dot(w) * vv - v.dot(w) * uv) / det : -1.0;
}

}  // namespace

/// (Q5) about x0, then about x1 along the edges x1x2 and y1y2, which meet the other panel there: what remains
/// is the potential of each panel at the far corner of the other, and edge x1x2 against y0y2, y1y2 against
/// x0x2.
Family common_edge_single_layer(const TouchingPair& pair, double tolerance) {
  const Triangle &x = pair.x, &y = pair.y;
  const PanelPotential of_x(x, pair.normal_x, 0), of_y(y, pair.normal_y, 0);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double rise_x = ax / (x[2] - x[0]).norm(), rise_y = ay / (y[2] - y[0]).norm();
  const double allowed = tolerance * (ax * ay / 4) / pair.diameter;
  const Family along_x = integrate_unit_segment<7>(
      [&](double s) { return line_single_layer((1 - s) * x[1] + s * x[2], y[0], y[2]); },
      std::array{closest_parameter(x[1], x[2], y[0], y[2])}, allowed / (ax * rise_y));
  const Family along_y = integrate_unit_segment<7>(
      [&](double s) { return line_single_layer((1 - s) * y[1] + s * y[2], x[0], x[2]); },
      std::array{closest_parameter(y[1], y[2], x[0], x[2])}, allowed / (ay * rise_x));
  return (ax * (of_y.single_layer(x[2]) + rise_y * along_x) +
          ay * (of_x.single_layer(y[2]) + rise_x * along_y)) /
         6;
}

/// As above with degree −2 for the kernel and −1 for its product with a corner function that vanishes at the
/// apex.
Vec3 common_edge_double_layer(const TouchingPair& pair, double tolerance) {
  const Triangle &x = pair.x, &y = pair.y;
  const Vec3& n = pair.normal_y;
  const PanelPotential of_x(x, pair.normal_x, pair.noise), of_y(y, n, pair.noise);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double rise_x = ax / (x[2] - x[0]).norm(), rise_y = ay / (y[2] - y[0]).norm();
  const double allowed = tolerance * (ax * ay / 4) / (pair.diameter * pair.diameter);

  // Edge x1x2 against Y: components 1, N₂ along y0y2 (N₀ is the rest, N₁ vanishes there).
  using Vec2 = Eigen::Vector2d;
  const Vec2 line_x = integrate_unit_segment<2>(
      [&](double s) {
        const LineField field = line_field((1 - s) * x[1] + s * x[2], y[0], y[2]);
        return Vec2(n.dot(field.total), n.dot(field.toward_b));
      },
      std::array{closest_parameter(x[1], x[2], y[0], y[2])}, allowed / (ax * rise_y));
  const Vec3 at_x2 = of_y.double_layer(x[2]);
  const double edge_total = at_x2.sum() + rise_y * line_x[0];
  const double edge_n0 = (at_x2[0] + rise_y * (line_x[0] - line_x[1])) / 2;
  const double edge_n2 = (at_x2[2] + rise_y * line_x[1]) / 2;
  const double edge_n1 = edge_total - edge_n0 - edge_n2;

  // X against edge y1y2: components 1, N₂ = parameter along it (N₁ is the rest, N₀ vanishes there).
  const Vec2 line_y = integrate_unit_segment<2>(
      [&](double s) {
        const double field = -n.dot(line_field((1 - s) * y[1] + s * y[2], x[0], x[2]).total);
        return Vec2(field, s * field);
      },
      std::array{closest_parameter(y[1], y[2], x[0], x[2])}, allowed / (ay * rise_x));
  const double at_y2 = n.dot(of_x.gradient(y[2]));
  const double field_total = at_y2 + rise_x * line_y[0];
  const double field_n2 = (at_y2 + rise_x * line_y[1]) / 2;

  const double total = (ax * edge_total + ay * field_total) / 2;
  const double n1 = (ax * edge_n1 + ay * (field_total - field_n2)) / 3;
  const double n2 = (ax * edge_n2 + ay * field_n2) / 3;
  return {total - n1 - n2, n1, n2};
}

}  // namespace conchoid
