#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/graded.hpp"
#include "conchoid/quadrature/segment_quadrature.hpp"
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
};

NearPair near_pair(const Panel& x, const Panel& y) {
  return NearPair(x, y, x.radius <= y.radius ? x.center : y.center, plane_noise(x, y));
}

double largest_height(const Triangle& t, const PanelPotential& plane) {
  return std::max({std::abs(plane.height(t[0])), std::abs(plane.height(t[1])), std::abs(plane.height(t[2]))});
}

/// A point of both planes close to the origin, if they meet: exactly, or up to `gap` because they coincide so
/// far.
std::optional<Vec3> common_point(const NearPair& pair, double gap) {
  if (std::max(largest_height(pair.x, pair.of_y), largest_height(pair.y, pair.of_x)) <= gap)
    return Vec3::Zero();
  const double sine2 = cross(pair.normal_x, pair.normal_y).squaredNorm();
  if (sine2 == 0) return std::nullopt;
  const double g = pair.normal_x.dot(pair.normal_y);
  const double dx = pair.normal_x.dot(pair.x[0]), dy = pair.normal_y.dot(pair.y[0]);
  return Vec3(((dx - g * dy) / sine2) * pair.normal_x + ((dy - g * dx) / sine2) * pair.normal_y);
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

/// Σ_e d_e ∫_e f over the edges of one panel, broken where they pass through the plane of the other.
template <int N, class F>
Eigen::Matrix<double, N, 1> over_edges(const PanelPotential& panel, const PanelPotential& other,
                                       const Vec3& c, double allowed, const F& f) {
  const std::array<double, 3> d = edge_distances(panel, c);
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = panel.corner(i), &b = panel.corner((i + 1) % 3);
    const double ha = other.height(a), hb = other.height(b);
    const double crossing = (ha < 0) != (hb < 0) ? ha / (ha - hb) : -1.0;
    const double factor = d[i] * panel.edge_length(i);
    if (factor == 0) continue;
    const auto on_edge = [&](double s) { return f((1 - s) * a + s * b); };
    sum += factor * integrate_unit_segment<N>(on_edge, std::array{crossing}, allowed / std::abs(factor));
  }
  return sum;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double s = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - s * ab).norm();
}

double distance_to_panel(const Vec3& p, const PanelPotential& panel) {
  if (panel.corner_functions(p).minCoeff() >= 0) return std::abs(panel.height(p));
  return std::min({distance_to_segment(p, panel.corner(0), panel.corner(1)),
                   distance_to_segment(p, panel.corner(1), panel.corner(2)),
                   distance_to_segment(p, panel.corner(2), panel.corner(0))});
}

Vec3 centroid(const Triangle& t) {
  return (t[0] + t[1] + t[2]) / 3;
}

double radius(const Triangle& t, const Vec3& center) {
  return std::max({(t[0] - center).norm(), (t[1] - center).norm(), (t[2] - center).norm()});
}

/// ∫ over a triangle of f, smooth on the scale of the distance from `source`: cut at the longest edge until a
/// rule suffices. False, and nothing of use in sum, when that would take more than `budget` points.
template <int N, class F>
bool over_cells(Layer layer, const Triangle& whole, double area, const PanelPotential& source,
                double tolerance, int budget, const F& f, Eigen::Matrix<double, N, 1>& sum) {
  struct Cell {
    Triangle corners;
    double area;
  };
  sum.setZero();
  std::array<Cell, 40> stack;
  int top = 0;
  stack[top++] = {whole, area};
  while (top > 0) {
    const Cell cell = stack[--top];
    const Triangle& t = cell.corners;
    const Vec3 center = centroid(t);
    const int degree = far_degree(layer, radius(t, center), distance_to_panel(center, source), tolerance);
    if (degree > 0) {
      const auto points = triangle_rule(degree).points;
      budget -= static_cast<int>(points.size());
      if (budget < 0) return false;
      for (const RulePoint& p : points)
        sum += (p.weight * cell.area) * f(rule_point(t, p));
      continue;
    }
    if (top + 2 > static_cast<int>(stack.size())) return false;
    budget -= 3;
    const std::array<double, 3> length2 = {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(),
                                           (t[0] - t[2]).squaredNorm()};
    const int i = static_cast<int>(std::max_element(length2.begin(), length2.end()) - length2.begin());
    const Vec3 mid = 0.5 * (t[i] + t[(i + 1) % 3]);
    stack[top++] = {{t[i], mid, t[(i + 2) % 3]}, cell.area / 2};
    stack[top++] = {{mid, t[(i + 1) % 3], t[(i + 2) % 3]}, cell.area / 2};
  }
  return true;
}

constexpr int cheap_budget = 150;    // points: about the price of the edge form
constexpr int costly_budget = 4000;  // points: about the price of the graded form

}  // namespace

Family near_single_layer(const Panel& px, const Panel& py, double tolerance) {
  const NearPair pair = near_pair(px, py);
  Family sum;
  const bool outer_x = pair.radius_x <= pair.radius_y;
  const PanelPotential& inner = outer_x ? pair.of_y : pair.of_x;
  const Triangle& outer = outer_x ? pair.x : pair.y;
  const double outer_area = outer_x ? pair.area_x : pair.area_y;
  const auto potential = [&](const Vec3& p) { return inner.single_layer(p); };
  if (over_cells<7>(Layer::single, outer, outer_area, inner, tolerance, cheap_budget, potential, sum))
    return sum;

  const double gap = std::max(pair.noise, 1e-3 * tolerance * std::min(pair.radius_x, pair.radius_y));
  if (const std::optional<Vec3> c = common_point(pair, gap)) {
    const double loss = std::max(amplification(pair.of_x, *c), amplification(pair.of_y, *c));
    if (loss * 1000 * epsilon <= tolerance) {
      const double allowed = tolerance * pair.area_x * pair.area_y / pair.diameter;
      return (over_edges<7>(pair.of_x, pair.of_y, *c, allowed,
                            [&](const Vec3& p) { return pair.of_y.single_layer(p); }) +
              over_edges<7>(pair.of_y, pair.of_x, *c, allowed,
                            [&](const Vec3& p) { return pair.of_x.single_layer(p); })) /
             3;
    }
  }
  if (over_cells<7>(Layer::single, outer, outer_area, inner, tolerance, costly_budget, potential, sum))
    return sum;
  return integrate_graded<7>(outer, inner, tolerance, potential);
}

Vec3 near_double_layer(const Panel& px, const Panel& py, double tolerance) {
  const NearPair pair = near_pair(px, py);
  if (coplanar(pair.x, pair.of_y, pair.noise)) return Vec3::Zero();
  Vec3 sum;
  const auto potential = [&](const Vec3& p) { return pair.of_y.double_layer(p); };
  if (over_cells<3>(Layer::dbl, pair.x, pair.area_x, pair.of_y, tolerance, cheap_budget, potential, sum))
    return sum;

  if (const std::optional<Vec3> c = common_point(pair, 0)) {
    const Vec3 at_c = pair.of_y.corner_functions(*c);
    const double loss = std::max(amplification(pair.of_x, *c), amplification(pair.of_y, *c)) *
                        std::max(1.0, at_c.cwiseAbs().maxCoeff());
    if (loss * 1000 * epsilon <= tolerance) {
      // N_j = N_j(c) + a part that vanishes at c: degree −2 (divisor 2) and −1 (divisor 3).
      const double allowed = tolerance * pair.area_x * pair.area_y / (pair.diameter * pair.diameter);
      return over_edges<3>(pair.of_x, pair.of_y, *c, allowed,
                           [&](const Vec3& p) {
                             const Vec3 v = pair.of_y.double_layer(p);
                             return Vec3(v / 3 + (v.sum() / 6) * at_c);
                           }) +
             over_edges<3>(pair.of_y, pair.of_x, *c, allowed, [&](const Vec3& p) {
               const double field = pair.normal_y.dot(pair.of_x.gradient(p));
               return Vec3(field * (pair.of_y.corner_functions(p) / 3 + at_c / 6));
             });
    }
  }
  if (over_cells<3>(Layer::dbl, pair.x, pair.area_x, pair.of_y, tolerance, costly_budget, potential, sum))
    return sum;
  return integrate_graded<3>(pair.x, pair.of_y, tolerance, potential);
}

}  // namespace conchoid
