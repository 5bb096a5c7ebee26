#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/point_quadrature.hpp"

namespace conchoid {

namespace {

/// From corner 1 to corner 2.
Points points(const Triangle& t, const Parameters& s) {
  return points_between(t[1], t[2], s);
}
SteepPlaces steep_on_edge(const Triangle& edge_of, const Triangle& other) {
  return steep_places(edge_of[1], edge_of[2], other[0], other[2]);
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
      [&](const Parameters& s, PointValues<7>& v) { line_single_layer(points(x, s), y[0], y[2], v); },
      steep_on_edge(x, y), allowed / (ax * rise_y));
  const Family along_y = integrate_unit_segment<7>(
      [&](const Parameters& s, PointValues<7>& v) { line_single_layer(points(y, s), x[0], x[2], v); },
      steep_on_edge(y, x), allowed / (ay * rise_x));
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
      [&](const Parameters& s, PointValues<2>& v) { line_field_along(n, points(x, s), y[0], y[2], v); },
      steep_on_edge(x, y), allowed / (ax * rise_y));
  const Vec3 at_x2 = of_y.double_layer(x[2]);
  const double edge_total = at_x2.sum() + rise_y * line_x[0];
  const double edge_n0 = (at_x2[0] + rise_y * (line_x[0] - line_x[1])) / 2;
  const double edge_n2 = (at_x2[2] + rise_y * line_x[1]) / 2;
  const double edge_n1 = edge_total - edge_n0 - edge_n2;

  // X against edge y1y2: components 1, N₂ = parameter along it (N₁ is the rest, N₀ vanishes there).
  const Vec2 line_y = integrate_unit_segment<2>(
      [&](const Parameters& s, PointValues<2>& v) {
        line_field_along(-n, points(y, s), x[0], x[2], v);
        for (int i = 0; i < Points::most; ++i)
          v.of[1][i] = s[i] * v.of[0][i];
      },
      steep_on_edge(y, x), allowed / (ay * rise_x));
  const double at_y2 = n.dot(of_x.gradient(y[2]));
  const double field_total = at_y2 + rise_x * line_y[0];
  const double field_n2 = (at_y2 + rise_x * line_y[1]) / 2;

  const double total = (ax * edge_total + ay * field_total) / 2;
  const double n1 = (ax * edge_n1 + ay * (field_total - field_n2)) / 3;
  const double n2 = (ax * edge_n2 + ay * field_n2) / 3;
  return {total - n1 - n2, n1, n2};
}

}  // namespace conchoid
