#pragma once

#include "conchoid/quadrature/lanes.hpp"
#include "conchoid/quadrature/point_potentials.hpp"
#include "conchoid/quadrature/segment_quadrature.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

/// integrate_segment for functions that are evaluated at all points of a Kronrod rule at once, and that are
/// steep at known places.
namespace conchoid {

/// The rule on [0, 1] in ascending order, filled up with a point of weight 0.
struct KronrodPoints {
  alignas(32) double node[Points::most], weight[Points::most], gauss_weight[Points::most];
};
const KronrodPoints& kronrod_points();

/// Parameters of points along a segment.
using Parameters = double[Points::most];

/// Points on the segment from a to b.
inline Points points_between(const Vec3& a, const Vec3& b, const Parameters& s) {
  Points points;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < Points::most; ++i)
      points.at[k][i] = (1 - s[i]) * a[k] + s[i] * b[k];
  return points;
}

/// Values of n functions, weighed: their integrals, the difference of the rules where it is largest, and the
/// integral of the largest absolute value.
struct Weighed {
  double difference, size;
};
constexpr int most_values = 63;
Weighed weigh(const double (*values)[Points::most], const Parameters& stretch, int n, double* integrals);

/// A segment in pieces: f is steep at some of the pieces' ends, where the parameter is stretched by a power:
/// s ∝ t³ makes of s log s or of a peak next to the segment something that Gauss rules follow.
class SteepPlaces {
 public:
  /// Something steep at parameter s, felt on both sides. Near ones are taken for one.
  void add(double s);
  struct Piece {
    double from, to;
    bool steep_from, steep_to;
    /// Parameters and ds/dt, of 16 values t in [0, 1]
    void stretch(const Parameters& t, Parameters& s, Parameters& slope) const;
  };
  /// Calls f(piece) for each.
  template <class F>
  void each(const F& f) const {
    double from = 0;
    bool steep = steep_start_;
    for (int i = 0; i < count_; ++i) {
      f(Piece{from, at_[static_cast<std::size_t>(i)], steep, true});
      from = at_[static_cast<std::size_t>(i)];
      steep = true;
    }
    f(Piece{from, 1.0, steep, steep_end_});
  }

 private:
  std::array<double, 8> at_{};
  int count_ = 0;
  bool steep_start_ = false, steep_end_ = false;
};

/// Where a potential of the triangle `panel` is steep along the segment from a to b: next to its edges, and
/// where the segment passes through its plane.
SteepPlaces steep_places(const Vec3& a, const Vec3& b, const PanelPotential& panel);
/// The same for a potential of the segment from c to d.
SteepPlaces steep_places(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Mean over a triangle of f by a rule.
/// @param f  f(points, values), a part of the rule's points at once
template <int N, class F>
Eigen::Matrix<double, N, 1> rule_mean_at_once(const Triangle& t, const TriangleRule& rule, const F& f) {
  const int count = static_cast<int>(rule.points.size());
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (int begin = 0; begin < count; begin += Points::most) {
    const int taken = std::min(count - begin, Points::most);
    Points points;
    points.padded = (taken + lanes - 1) / lanes * lanes;
    for (int i = 0; i < points.padded; ++i) {
      const Vec3 p = rule_point(t, rule.points[static_cast<std::size_t>(begin + std::min(i, taken - 1))]);
      for (int k = 0; k < 3; ++k)
        points.at[k][i] = p[k];
    }
    PointValues<N> values;
    f(points, values);
    for (int i = 0; i < taken; ++i)
      for (int k = 0; k < N; ++k)
        sum[k] += rule.points[static_cast<std::size_t>(begin + i)].weight * values.of[k][i];
  }
  return sum;
}

/// ∫ over [0, 1] of f.
/// @param f  f(parameters, values), all of them at once
template <int N, class F>
Eigen::Matrix<double, N, 1> integrate_unit_segment(const F& f, const SteepPlaces& places, double tolerance,
                                                   double rounding = 50 *
                                                                     std::numeric_limits<double>::epsilon()) {
  static_assert(N <= most_values);
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  places.each([&](const SteepPlaces::Piece& piece) {
    const auto rule = [&](double a, double b) {
      const KronrodPoints& kronrod = kronrod_points();
      alignas(32) Parameters t, s, slope;
      for (int i = 0; i < Points::most; ++i)
        t[i] = a + (b - a) * kronrod.node[i];
      piece.stretch(t, s, slope);
      PointValues<N> values;
      f(s, values);
      KronrodInterval<N> result{a, b, {}, 0};
      const Weighed w = weigh(values.of, slope, N, result.value.data());
      result.value *= b - a;
      const bool done = !(w.difference > rounding * w.size) || !(a < 0.5 * (a + b) && 0.5 * (a + b) < b);
      result.error = done ? 0.0 : (b - a) * w.difference;
      return result;
    };
    sum += integrate_by<N>(rule, 0, 1, tolerance);
  });
  return sum;
}

}  // namespace conchoid
