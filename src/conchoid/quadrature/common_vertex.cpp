#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/point_quadrature.hpp"

namespace conchoid {

namespace {

/// Where the potential of the other panel is steep along the edge from corner 1 to corner 2.
SteepPlaces steep_on_edge(const Triangle& edge_of, const PanelPotential& other) {
  return steep_places(edge_of[1], edge_of[2], other);
}

Points points(const Triangle& t, const Parameters& s) {
  return points_between(t[1], t[2], s);
}

}  // namespace

/// (Q5) about the common vertex: only the edges opposite to it remain, with d_e · length = twice the panel's
/// area.
Family common_vertex_single_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, 0), of_y(pair.y, pair.normal_y, 0);
  const PointPotentials around_x(of_x), around_y(of_y);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / pair.diameter;
  const Family from_x = integrate_unit_segment<7>(
      [&](const Parameters& s, PointValues<7>& v) { around_y.single_layer(points(pair.x, s), v); },
      steep_on_edge(pair.x, of_y), allowed / ax);
  const Family from_y = integrate_unit_segment<7>(
      [&](const Parameters& s, PointValues<7>& v) { around_x.single_layer(points(pair.y, s), v); },
      steep_on_edge(pair.y, of_x), allowed / ay);
  return (ax * around_y.in_space(from_x) + ay * around_x.in_space(from_y)) / 3;
}

/// The kernel has degree −2 (divisor 2), times N₁ or N₂, which vanish linearly at the vertex, −1 (divisor 3);
/// N₀ = 1 − N₁ − N₂.
Vec3 common_vertex_double_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, pair.noise), of_y(pair.y, pair.normal_y, pair.noise);
  const PointPotentials around_x(of_x), around_y(of_y);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / (pair.diameter * pair.diameter);
  const Vec3 from_x = integrate_unit_segment<3>(
      [&](const Parameters& s, PointValues<3>& v) { around_y.double_layer(points(pair.x, s), v); },
      steep_on_edge(pair.x, of_y), allowed / ax);
  const auto field_on_y = [&](const Parameters& s, PointValues<3>& v) {
    PointValues<1> field;
    around_x.gradient_along(pair.normal_y, points(pair.y, s), field);
    for (int i = 0; i < Points::most; ++i) {
      v.of[0][i] = field.of[0][i];
      v.of[1][i] = (1 - s[i]) * field.of[0][i];
      v.of[2][i] = s[i] * field.of[0][i];
    }
  };
  const Vec3 from_y = integrate_unit_segment<3>(field_on_y, steep_on_edge(pair.y, of_x), allowed / ay);
  const double total = (ax * from_x.sum() + ay * from_y[0]) / 2;
  const double n1 = (ax * from_x[1] + ay * from_y[1]) / 3;
  const double n2 = (ax * from_x[2] + ay * from_y[2]) / 3;
  return {total - n1 - n2, n1, n2};
}

}  // namespace conchoid
