#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/cells.hpp"
#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/graded.hpp"
#include "conchoid/quadrature/point_quadrature.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two panels in coordinates around the smaller one's center.
struct NearPair {
  Triangle x, y;
  Vec3 normal_x, normal_y;
  double area_x, area_y, radius_x, radius_y;
  double noise, diameter;
  PanelPotential of_x, of_y;

  NearPair(const Panel& px, const Panel& py, const Vec3& origin, double rounding)
      : x{px.x[0] - origin, px.x[1] - origin, px.x[2] - origin},
        y{py.x[0] - origin, py.x[1] - origin, py.x[2] - origin},
        normal_x(px.normal),
        normal_y(py.normal),
        area_x(px.area),
        area_y(py.area),
        radius_x(px.radius),
        radius_y(py.radius),
        noise(rounding),
        diameter((px.center - py.center).norm() + px.radius + py.radius),
        of_x(x, normal_x, rounding),
        of_y(y, normal_y, rounding) {}

  ParallelPair as_parallel() const { return {of_x, of_y, diameter}; }
};

NearPair near_pair(const Panel& x, const Panel& y) {
  return NearPair(x, y, x.radius <= y.radius ? x.center : y.center, plane_noise(x, y));
}

double largest_height(const Triangle& t, const PanelPotential& plane) {
  return std::max({std::abs(plane.height(t[0])), std::abs(plane.height(t[1])), std::abs(plane.height(t[2]))});
}

/// Heights that change no integral by as much as the tolerance.
double negligible(const NearPair& pair, double tolerance) {
  return std::max(pair.noise, 1e-3 * tolerance * std::min(pair.radius_x, pair.radius_y));
}

struct Heights {
  double low, high;
};
Heights heights(const Triangle& t, const PanelPotential& plane) {
  const double a = plane.height(t[0]), b = plane.height(t[1]), c = plane.height(t[2]);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

/// In parallel planes, and not so thin that the terms at the edges cancel: of the digits at stake by their size a
/// hundredth is lost (measured).
bool parallel(const NearPair& pair, double tolerance) {
  const Heights of_x = heights(pair.x, pair.of_y);
  return of_x.high - of_x.low <= negligible(pair, tolerance) &&
         0.1 * epsilon * parallel_loss(pair.as_parallel()) <= tolerance;
}

/// X is on one side of the plane of Y, by more than rounding.
bool on_one_side(const NearPair& pair) {
  const Heights of_x = heights(pair.x, pair.of_y);
  return of_x.low > pair.noise || of_x.high < -pair.noise;
}

/// Outward distances of a panel's edges from c.
std::array<double, 3> edge_distances(const PanelPotential& panel, const Vec3& c) {
  std::array<double, 3> d;
  for (int i = 0; i < 3; ++i)
    d[i] = panel.edge_normal(i).dot(panel.corner(i) - c);
  return d;
}

/// How many times larger than the integral the terms of (Q5) are: 1 when c lies in both panels.
double amplification(const PanelPotential& panel, const Vec3& c) {
  const std::array<double, 3> d = edge_distances(panel, c);
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += std::abs(d[i]) * panel.edge_length(i);
  return sum / panel.double_area();
}

/// A point of both planes, and how many digits (Q5) loses to cancellation when taken about it.
struct Apex {
  Vec3 c;
  double loss;
};

/// @param with_corners  the corner functions of Y enter too
double loss_about(const NearPair& pair, const Vec3& c, bool with_corners) {
  const double terms = std::max(amplification(pair.of_x, c), amplification(pair.of_y, c));
  return with_corners ? terms * std::max(1.0, pair.of_y.corner_functions(c).cwiseAbs().maxCoeff()) : terms;
}

/// The best of a few points where the planes meet: closest to either panel, and where their line crosses the
/// edge lines.
std::optional<Apex> best_apex(const NearPair& pair, bool with_corners) {
  const Vec3 direction = cross(pair.normal_x, pair.normal_y);
  const double sine2 = direction.squaredNorm();
  if (sine2 == 0) return std::nullopt;
  const double g = pair.normal_x.dot(pair.normal_y);
  const double dx = pair.normal_x.dot(pair.x[0]), dy = pair.normal_y.dot(pair.y[0]);
  const Vec3 start = ((dx - g * dy) / sine2) * pair.normal_x + ((dy - g * dx) / sine2) * pair.normal_y;
  Apex best{start, loss_about(pair, start, with_corners)};
  const auto consider = [&](double along) {
    if (!std::isfinite(along)) return;
    const Vec3 c = start + along * direction;
    const double loss = loss_about(pair, c, with_corners);
    if (loss < best.loss) best = {c, loss};
  };
  for (const PanelPotential* panel : {&pair.of_x, &pair.of_y}) {
    const Vec3 center = (panel->corner(0) + panel->corner(1) + panel->corner(2)) / 3;
    consider(direction.dot(center - start) / sine2);
    for (int e = 0; e < 3; ++e) {
      consider(panel->edge_normal(e).dot(panel->corner(e) - start) / panel->edge_normal(e).dot(direction));
    }
  }
  return best;
}

/// (Q5) about c keeps the tolerance in spite of rounding.
bool accurate(const Apex& apex, double tolerance) {
  return apex.loss * 200 * epsilon <= tolerance;
}

/// So steep to each other that neither cells nor grading would resolve the panels' crossing: (Q5) whatever it
/// loses.
bool steep(const NearPair& pair) {
  return cross(pair.normal_x, pair.normal_y).squaredNorm() > 1e-2;
}

/// Σ_e d_e ∫_e f over the edges of one panel, f a potential of the other.
/// @param f  f(points, values), all of them at once
template <int N, class F>
Eigen::Matrix<double, N, 1> over_edges(const PanelPotential& panel, const PanelPotential& other,
                                       const Vec3& c, double allowed, double rounding, const F& f) {
  const std::array<double, 3> d = edge_distances(panel, c);
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = panel.corner(i), &b = panel.corner((i + 1) % 3);
    const double factor = d[i] * panel.edge_length(i);
    if (factor == 0) continue;
    const auto on_edge = [&](const Parameters& s, PointValues<N>& v) { f(points_between(a, b, s), v); };
    sum += factor * integrate_unit_segment<N>(on_edge, steep_places(a, b, other), allowed / std::abs(factor),
                                              rounding);
  }
  return sum;
}

/// X lies in the plane of Y, up to rounding.
bool in_plane_of(const Panel& y, const Panel& x) {
  const double noise = plane_noise(x, y);
  return std::all_of(x.x.begin(), x.x.end(),
                     [&](const Vec3& c) { return std::abs(y.normal.dot(c - y.x[0])) <= noise; });
}

constexpr int cheap_budget = 150;    // points: about the price of the edge form
constexpr int costly_budget = 4000;  // points: about the price of the graded form

}  // namespace

Family near_single_layer(const Panel& px, const Panel& py, double tolerance) {
  Family sum;
  if (cells_single_layer(px, py, tolerance, cheap_budget, sum)) return sum;
  const NearPair pair = near_pair(px, py);
  const PointPotentials around_x(pair.of_x), around_y(pair.of_y);
  const auto about = [&](const Vec3& c) {
    const double allowed = tolerance * pair.area_x * pair.area_y / pair.diameter;
    const double rounding = 50 * epsilon;
    const auto of_x = [&](const Points& p, PointValues<7>& v) { around_x.single_layer(p, v); };
    const auto of_y = [&](const Points& p, PointValues<7>& v) { around_y.single_layer(p, v); };
    return Family((around_y.in_space(over_edges<7>(pair.of_x, pair.of_y, c, allowed, rounding, of_y)) +
                   around_x.in_space(over_edges<7>(pair.of_y, pair.of_x, c, allowed, rounding, of_x))) /
                  3);
  };
  if (parallel(pair, tolerance)) return parallel_single_layer(pair.as_parallel(), tolerance);
  if (std::max(largest_height(pair.x, pair.of_y), largest_height(pair.y, pair.of_x)) <=
      negligible(pair, tolerance))
    return about(Vec3::Zero());
  const std::optional<Apex> apex = best_apex(pair, false);
  if (apex && accurate(*apex, tolerance)) return about(apex->c);
  if (cells_single_layer(px, py, tolerance, costly_budget, sum)) return sum;
  if (apex && steep(pair)) return about(apex->c);
  const bool outer_x = pair.radius_x <= pair.radius_y;
  const PanelPotential& inner = outer_x ? pair.of_y : pair.of_x;
  return integrate_graded<7>(outer_x ? pair.x : pair.y, inner, tolerance,
                             [&](const Vec3& p) { return inner.single_layer(p); });
}

Vec3 near_double_layer(const Panel& px, const Panel& py, double tolerance) {
  if (in_plane_of(py, px)) return Vec3::Zero();
  Vec3 sum;
  if (cells_double_layer(px, py, tolerance, cheap_budget, sum)) return sum;
  const NearPair pair = near_pair(px, py);
  const PointPotentials around_x(pair.of_x), around_y(pair.of_y);
  // N_j = N_j(c) + a part that vanishes at c: degree −2 (divisor 2) and −1 (divisor 3).
  const auto about = [&](const Vec3& c) {
    const double allowed = tolerance * pair.area_x * pair.area_y / (pair.diameter * pair.diameter);
    const Vec3 at_c = pair.of_y.corner_functions(c);
    // Heights are rounded relative to the length of Y, corner functions relative to its thickness.
    const double rounding = 50 * epsilon * pair.radius_y * pair.radius_y / pair.area_y;
    const auto of_y = [&](const Points& p, PointValues<3>& v) {
      around_y.double_layer(p, v);
      for (int i = 0; i < p.padded; ++i) {
        const double all = (v.of[0][i] + v.of[1][i] + v.of[2][i]) / 6;
        for (int k = 0; k < 3; ++k)
          v.of[k][i] = v.of[k][i] / 3 + all * at_c[k];
      }
    };
    const auto of_x = [&](const Points& p, PointValues<3>& v) {
      PointValues<1> field;
      around_x.gradient_along(pair.normal_y, p, field);
      for (int i = 0; i < p.padded; ++i) {
        const Vec3 N = pair.of_y.corner_functions({p.at[0][i], p.at[1][i], p.at[2][i]});
        for (int k = 0; k < 3; ++k)
          v.of[k][i] = field.of[0][i] * (N[k] / 3 + at_c[k] / 6);
      }
    };
    return Vec3(over_edges<3>(pair.of_x, pair.of_y, c, allowed, rounding, of_y) +
                over_edges<3>(pair.of_y, pair.of_x, c, allowed, rounding, of_x));
  };
  if (parallel(pair, tolerance) && on_one_side(pair))
    return parallel_double_layer(pair.as_parallel(), tolerance);
  const std::optional<Apex> apex = best_apex(pair, true);
  if (apex && accurate(*apex, tolerance)) return about(apex->c);
  if (cells_double_layer(px, py, tolerance, costly_budget, sum)) return sum;
  if (apex && steep(pair)) return about(apex->c);
  return integrate_graded<3>(pair.x, pair.of_y, tolerance,
                             [&](const Vec3& p) { return pair.of_y.double_layer(p); });
}

}  // namespace conchoid
