#include <cmath>

#include "conchoid/quadrature/cells.hpp"
#include "conchoid/quadrature/graded.hpp"
#include "conchoid/quadrature/polynomial_cases.hpp"

namespace conchoid {

namespace {

constexpr int most_points = 60000;

/// From a cell to where the potential of `source` is not smooth: on one side of its plane that is its edges alone.
double distance_to_steep(const Triangle& cell, const Vec3& center, const PanelPotential& source) {
  const double h0 = source.height(cell[0]), h1 = source.height(cell[1]), h2 = source.height(cell[2]);
  const bool one_side = (h0 > 0 && h1 > 0 && h2 > 0) || (h0 < 0 && h1 < 0 && h2 < 0);
  if (!one_side) return distance_to_panel(center, source);
  return std::min({distance_to_segment(center, source.corner(0), source.corner(1)),
                   distance_to_segment(center, source.corner(1), source.corner(2)),
                   distance_to_segment(center, source.corner(2), source.corner(0))});
}

/// ∫ over a panel of potentials of another, which shares no vertex with it.
template <class Moments, class F>
Moments over_panel(Layer layer, int density, const Panel& outer, const PanelPotential& inner,
                   double tolerance, const F& f) {
  constexpr int N = Moments::SizeAtCompileTime;
  using Flat = Eigen::Matrix<double, N, 1>;
  const auto flat = [&](const Vec3& p) {
    const Moments m = f(p);
    return Flat(Eigen::Map<const Flat>(m.data()));
  };
  const auto degree_of = [&](const Triangle& t) {
    const Vec3 center = center_of(t);
    return far_degree(layer, radius_of(t, center), distance_to_steep(t, center, inner), tolerance, density);
  };
  const auto mean_of = [&](const Triangle& t, const TriangleRule& rule) {
    return rule_mean<N>(t, rule, flat);
  };
  Flat sum;
  if (!over_cells<N>(outer.x, outer.area, degree_of, most_points, mean_of, sum))
    sum = integrate_graded<N>(outer.x, inner, tolerance, flat);
  return Eigen::Map<const Moments>(sum.data());
}

}  // namespace

LinearMoments near_linear_single_layer(const Panel& x, const Panel& y, double tolerance) {
  const bool outer_x = x.radius <= y.radius;
  const Panel &outer = outer_x ? x : y, &inner = outer_x ? y : x;
  const PanelPotential of_inner(inner.x, inner.normal, plane_noise(x, y));
  const PanelPotential of_outer(outer.x, outer.normal, 0);
  return over_panel<LinearMoments>(Layer::single, 1, outer, of_inner, tolerance, [&](const Vec3& p) {
    const Eigen::Matrix<double, 7, 3> of = of_inner.linear_single_layer(p);
    const Vec3 N = of_outer.corner_functions(p);
    LinearMoments m;
    if (outer_x)
      m << of, N[1] * of, N[2] * of;
    else
      for (int a = 0; a < 3; ++a) {
        m.col(3 * a) = of.col(a);
        m.col(3 * a + 1) = N[1] * of.col(a);
        m.col(3 * a + 2) = N[2] * of.col(a);
      }
    return m;
  });
}

QuadraticMoments near_quadratic_double_layer(const Panel& x, const Panel& y, double tolerance) {
  const double noise = plane_noise(x, y);
  const PanelPotential of_x(x.x, x.normal, noise), of_y(y.x, y.normal, noise);
  if (coplanar(x.x, of_y, noise)) return QuadraticMoments::Zero();
  if (x.radius <= y.radius)
    return over_panel<QuadraticMoments>(Layer::dbl, 1, x, of_y, tolerance, [&](const Vec3& p) {
      const Vec3 N = of_x.corner_functions(p);
      return QuadraticMoments(linear_monomials(N[1], N[2]) * of_y.quadratic_double_layer(p).transpose());
    });
  return over_panel<QuadraticMoments>(Layer::dbl, 2, y, of_x, tolerance, [&](const Vec3& p) {
    const Vec3 N = of_y.corner_functions(p);
    return QuadraticMoments(of_x.linear_gradient(p).transpose() * y.normal *
                            quadratic_monomials(N[1], N[2]).transpose());
  });
}

}  // namespace conchoid
