#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/segment_quadrature.hpp"

namespace conchoid {

namespace {

/// Where the edge from corner 1 to corner 2 passes through the plane of the other panel, or outside (0, 1).
double crossing(const Triangle& edge_of, const PanelPotential& other) {
  const double h1 = other.height(edge_of[1]), h2 = other.height(edge_of[2]);
  return (h1 < 0) != (h2 < 0) ? h1 / (h1 - h2) : -1.0;
}

Vec3 point(const Triangle& t, double s) {
  return (1 - s) * t[1] + s * t[2];
}

}  // namespace

/// (Q5) about the common vertex: only the edges opposite to it remain, with d_e · length = twice the panel's
/// area.
Family common_vertex_single_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, 0), of_y(pair.y, pair.normal_y, 0);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / pair.diameter;
  const Family from_x =
      integrate_unit_segment<7>([&](double s) { return of_y.single_layer(point(pair.x, s)); },
                                std::array{crossing(pair.x, of_y)}, allowed / ax);
  const Family from_y =
      integrate_unit_segment<7>([&](double s) { return of_x.single_layer(point(pair.y, s)); },
                                std::array{crossing(pair.y, of_x)}, allowed / ay);
  return (ax * from_x + ay * from_y) / 3;
}

/// The kernel has degree −2 (divisor 2), times N₁ or N₂, which vanish linearly at the vertex, −1 (divisor 3);
/// N₀ = 1 − N₁ − N₂.
Vec3 common_vertex_double_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, pair.noise), of_y(pair.y, pair.normal_y, pair.noise);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / (pair.diameter * pair.diameter);
  const Vec3 from_x = integrate_unit_segment<3>([&](double s) { return of_y.double_layer(point(pair.x, s)); },
                                                std::array{crossing(pair.x, of_y)}, allowed / ax);
  const auto field_on_y = [&](double s) {
    const double field = pair.normal_y.dot(of_x.gradient(point(pair.y, s)));
    return Vec3(field, (1 - s) * field, s * field);
  };
  const Vec3 from_y = integrate_unit_segment<3>(field_on_y, std::array{crossing(pair.y, of_x)}, allowed / ay);
  const double total = (ax * from_x.sum() + ay * from_y[0]) / 2;
  const double n1 = (ax * from_x[1] + ay * from_y[1]) / 3;
  const double n2 = (ax * from_x[2] + ay * from_y[2]) / 3;
  return {total - n1 - n2, n1, n2};
}

}  // namespace conchoid
