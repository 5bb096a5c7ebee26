#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/cells.hpp"
#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/point_quadrature.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

/// ∫ over a triangle of a potential of `source`, smooth on the scale of the distance from it.
/// @param f  f(points, values), some of them at once
template <int N, class F>
bool over_smooth_cells(Layer layer, const Triangle& whole, double area, const PanelPotential& source,
                       double tolerance, int budget, const F& f, Eigen::Matrix<double, N, 1>& sum) {
  const auto degree_of = [&](const Triangle& t) {
    const Vec3 center = center_of(t);
    return far_degree(layer, radius_of(t, center), distance_to_panel(center, source), tolerance);
  };
  const auto mean_of = [&](const Triangle& t, const TriangleRule& rule) {
    return rule_mean_at_once<N>(t, rule, f);
  };
  return over_cells<N>(whole, area, degree_of, budget, mean_of, sum);
}

Triangle moved(const Panel& panel, const Vec3& origin) {
  return {panel.x[0] - origin, panel.x[1] - origin, panel.x[2] - origin};
}

}  // namespace

bool cells_single_layer(const Panel& x, const Panel& y, double tolerance, int budget, Family& sum) {
  const bool outer_x = x.radius <= y.radius;
  const Panel &outer = outer_x ? x : y, &inner = outer_x ? y : x;
  const PanelPotential source(moved(inner, outer.center), inner.normal, plane_noise(x, y));
  const PointPotentials around(source);
  const auto potential = [&](const Points& p, PointValues<7>& v) { around.single_layer(p, v); };
  if (!over_smooth_cells<7>(Layer::single, moved(outer, outer.center), outer.area, source, tolerance, budget,
                            potential, sum))
    return false;
  sum = around.in_space(sum);
  return true;
}

/// Potentials of Y over X, or the field of X over Y.
bool cells_double_layer(const Panel& x, const Panel& y, double tolerance, int budget, Vec3& sum) {
  const double cell_tolerance = tolerance / 4, noise = plane_noise(x, y);
  if (x.radius <= y.radius) {
    const PanelPotential of_y(moved(y, x.center), y.normal, noise);
    const PointPotentials around_y(of_y);
    const auto potential = [&](const Points& p, PointValues<3>& v) { around_y.double_layer(p, v); };
    return over_smooth_cells<3>(Layer::dbl, moved(x, x.center), x.area, of_y, cell_tolerance, budget,
                                potential, sum);
  }
  const Triangle own = moved(y, y.center);
  const PanelPotential of_x(moved(x, y.center), x.normal, noise), of_y(own, y.normal, noise);
  const PointPotentials around_x(of_x);
  const auto field = [&](const Points& p, PointValues<3>& v) {
    PointValues<1> along_normal;
    around_x.gradient_along(y.normal, p, along_normal);
    for (int i = 0; i < p.padded; ++i) {
      const Vec3 N = of_y.corner_functions({p.at[0][i], p.at[1][i], p.at[2][i]});
      for (int k = 0; k < 3; ++k)
        v.of[k][i] = along_normal.of[0][i] * N[k];
    }
  };
  return over_smooth_cells<3>(Layer::dbl, own, y.area, of_x, cell_tolerance, budget, field, sum);
}

}  // namespace conchoid
