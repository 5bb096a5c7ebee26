#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace conchoid {

/// Nodes in [0, 1) of the symmetric 15-point Kronrod rule on [−1, 1] with its weights, and the weights of the
/// embedded 7-point Gauss rule (0 where it has no node).                                   Piessens et al.,
/// QUADPACK, 1983
struct KronrodRule {
  static constexpr std::array<double, 8> node = {
      0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
      0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
      0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
      0.207784955007898467600689403773245, 0.0};
  static constexpr std::array<double, 8> weight = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr std::array<double, 8> gauss_weight = {
      0, 0.129484966168869693270611432679082, 0, 0.279705391489276667901467771423780,
      0, 0.381830050505118944950369775488975, 0, 0.417959183673469387755102040816327};
};

/// One interval's Kronrod value and how far the Gauss value is from it, in the component that differs most.
template <int N>
struct KronrodInterval {
  double a, b;
  Eigen::Matrix<double, N, 1> value;
  double error;
};

/// @param rounding  relative error of f itself: differences below it are not worth a bisection
template <int N, class F>
KronrodInterval<N> kronrod_interval(const F& f, double a, double b, double rounding) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const double mid = 0.5 * (a + b), half = 0.5 * (b - a);
  const Vector at_mid = f(mid);
  Vector kronrod = KronrodRule::weight[7] * at_mid;
  Vector gauss = KronrodRule::gauss_weight[7] * at_mid;
  double size = kronrod.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < 7; ++i) {
    const double d = half * KronrodRule::node[i];
    const Vector low = f(mid - d), high = f(mid + d);
    const Vector both = low + high;
    kronrod += KronrodRule::weight[i] * both;
    if (i % 2 == 1) gauss += KronrodRule::gauss_weight[i] * both;
    size += KronrodRule::weight[i] * (low.cwiseAbs() + high.cwiseAbs()).maxCoeff();
  }
  const double error = (kronrod - gauss).cwiseAbs().maxCoeff();
  const bool done = !(error > rounding * size) || !(a < mid && mid < b);
  return {a, b, half * kronrod, done ? 0.0 : half * error};
}

/// ∫_a^b of a vector-valued function by a rule with an estimate of its error: the interval with the largest
/// error halved until the errors add up to less than `tolerance` (absolute, in every component).
/// @param rule  rule(a, b), the KronrodInterval of an interval
template <int N, class Rule>
Eigen::Matrix<double, N, 1> integrate_by(const Rule& rule, double a, double b, double tolerance) {
  constexpr int max_intervals = 240;
  std::array<KronrodInterval<N>, max_intervals> intervals;
  int count = 0;
  intervals[count++] = rule(a, b);
  while (count < max_intervals) {
    int worst = 0;
    double error = 0;
    for (int i = 0; i < count; ++i) {
      error += intervals[i].error;
      if (intervals[i].error > intervals[worst].error) worst = i;
    }
    if (!(error > tolerance)) break;
    const double from = intervals[worst].a, to = intervals[worst].b, mid = 0.5 * (from + to);
    intervals[worst] = rule(from, mid);
    intervals[count++] = rule(mid, to);
  }
  Eigen::Matrix<double, N, 1> sum = intervals[0].value;
  for (int i = 1; i < count; ++i)
    sum += intervals[i].value;
  return sum;
}

/// ∫_a^b f(t) dt of a vector-valued function: the (7, 15) Gauss–Kronrod pair. The Kronrod values are far better
/// than their difference where f is smooth. Kinks, jumps and logarithms inside cost bisections, not accuracy;
/// what the caller knows of them belongs at an end.
template <int N, class F>
Eigen::Matrix<double, N, 1> integrate_segment(const F& f, double a, double b, double tolerance,
                                              double rounding = 50 * std::numeric_limits<double>::epsilon()) {
  const auto rule = [&](double from, double to) { return kronrod_interval<N>(f, from, to, rounding); };
  return integrate_by<N>(rule, a, b, tolerance);
}

/// The same over [0, 1], broken at the points of `breaks` that lie inside (any order, at most a few).
template <int N, std::size_t M, class F>
Eigen::Matrix<double, N, 1> integrate_unit_segment(const F& f, std::array<double, M> breaks, double tolerance,
                                                   double rounding = 50 *
                                                                     std::numeric_limits<double>::epsilon()) {
  std::sort(breaks.begin(), breaks.end());
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  double from = 0;
  for (double b : breaks) {
    if (!(b > from && b < 1)) continue;
    sum += integrate_segment<N>(f, from, b, tolerance, rounding);
    from = b;
  }
  return sum + integrate_segment<N>(f, from, 1.0, tolerance, rounding);
}

}  // namespace conchoid
