#include "conchoid/quadrature/point_quadrature.hpp"
#include "conchoid/quadrature/polynomial_cases.hpp"

namespace conchoid {

namespace {

Vec3 point(const Triangle& t, double s) {
  return (1 - s) * t[1] + s * t[2];
}

constexpr std::array<int, 6> degree = {0, 1, 1, 2, 2, 2};  // of the monomials, about corner 0

template <class Moments>
using Flat = Eigen::Matrix<double, Moments::SizeAtCompileTime, 1>;

/// ∫ over the edge opposite corner 0 of `edge_of`.
template <class Moments, class F>
Moments over_opposite_edge(const Triangle& edge_of, const PanelPotential& other, double allowed, const F& f) {
  constexpr int N = Moments::SizeAtCompileTime;
  const auto flat = [&](const Parameters& s, PointValues<N>& v) {
    for (int i = 0; i < Points::most; ++i) {
      const Moments m = f(s[i]);
      for (int k = 0; k < N; ++k)
        v.of[k][i] = m.data()[k];
    }
  };
  const Flat<Moments> sum =
      integrate_unit_segment<N>(flat, steep_places(edge_of[1], edge_of[2], other), allowed);
  return Eigen::Map<const Moments>(sum.data());
}

}  // namespace

/// (Q5) about corner 0, which the panels share: there the monomials are homogeneous, and the edges through it drop out.
LinearMoments touching_linear_single_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, 0), of_y(pair.y, pair.normal_y, 0);
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / pair.diameter;
  const LinearMoments on_x = over_opposite_edge<LinearMoments>(pair.x, of_y, allowed / ax, [&](double s) {
    const Eigen::Matrix<double, 7, 3> of = of_y.linear_single_layer(point(pair.x, s));
    LinearMoments m;
    m << of, (1 - s) * of, s * of;
    return m;
  });
  const LinearMoments on_y = over_opposite_edge<LinearMoments>(pair.y, of_x, allowed / ay, [&](double s) {
    const Eigen::Matrix<double, 7, 3> of = of_x.linear_single_layer(point(pair.y, s));
    LinearMoments m;
    for (int a = 0; a < 3; ++a) {
      m.col(3 * a) = of.col(a);
      m.col(3 * a + 1) = (1 - s) * of.col(a);
      m.col(3 * a + 2) = s * of.col(a);
    }
    return m;
  });
  LinearMoments sum = ax * on_x + ay * on_y;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      sum.col(static_cast<Eigen::Index>(3 * a + b)) /= 3 + degree[a] + degree[b];
  return sum;
}

QuadraticMoments touching_quadratic_double_layer(const TouchingPair& pair, double tolerance) {
  const PanelPotential of_x(pair.x, pair.normal_x, pair.noise), of_y(pair.y, pair.normal_y, pair.noise);
  if (coplanar(pair.x, of_y, pair.noise)) return QuadraticMoments::Zero();
  const double ax = of_x.double_area(), ay = of_y.double_area();
  const double allowed = tolerance * (ax * ay / 4) / (pair.diameter * pair.diameter);
  const QuadraticMoments on_x =
      over_opposite_edge<QuadraticMoments>(pair.x, of_y, allowed / ax, [&](double s) {
        return QuadraticMoments(linear_monomials(1 - s, s) *
                                of_y.quadratic_double_layer(point(pair.x, s)).transpose());
      });
  const QuadraticMoments on_y =
      over_opposite_edge<QuadraticMoments>(pair.y, of_x, allowed / ay, [&](double s) {
        return QuadraticMoments(of_x.linear_gradient(point(pair.y, s)).transpose() * pair.normal_y *
                                quadratic_monomials(1 - s, s).transpose());
      });
  QuadraticMoments sum = ax * on_x + ay * on_y;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t k = 0; k < 6; ++k)
      sum(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) /= 2 + degree[a] + degree[k];
  return sum;
}

}  // namespace conchoid
