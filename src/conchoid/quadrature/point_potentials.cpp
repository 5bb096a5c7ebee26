#include "conchoid/quadrature/point_potentials.hpp"

#include <limits>

#include "conchoid/quadrature/lanes.hpp"

namespace conchoid {

namespace {

using Numbers = PointPotentials::Numbers;
constexpr double smallest = std::numeric_limits<double>::min();

CONCHOID_INTO_CLONES void load(const Points& x, int j, Lanes (&to)[3]) {
  for (int k = 0; k < 3; ++k)
    to[k] = reinterpret_cast<const Lanes*>(x.at[k])[j];
}

CONCHOID_INTO_CLONES void dot(const double (&a)[3], const Lanes (&b)[3], Lanes& result) {
  result = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

CONCHOID_INTO_CLONES void from_to(const Lanes (&x)[3], const double (&corner)[3], Lanes (&to)[3], Lanes& r) {
  for (int k = 0; k < 3; ++k)
    to[k] = corner[k] - x[k];
  r = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
  take_root(r);
}

/// ∫ 1/R along a segment: log_term() of potentials.cpp.
CONCHOID_INTO_CLONES void log_term(const Lanes& s0, const Lanes& s1, const Lanes& r0, const Lanes& r1,
                                   double length, const Lanes& d2, Lanes& f) {
  const Lanes zero = {}, sum = r0 + r1;
  const IntLanes far = (IntLanes)(sum > 6 * length);
  const IntLanes before = (IntLanes)(s0 >= 0), behind = (IntLanes)(s1 <= 0);
  const Lanes forward = r1 + s1, backward = r0 - s0;
  const Lanes numerator = before ? forward : behind ? backward : forward * backward;
  const Lanes denominator = before ? r0 + s0 : behind ? r1 - s1 : d2;
  log_of_ratio(numerator, denominator, far, zero + length, sum, f);
  f = (far | (IntLanes)(denominator > smallest)) ? f : zero;
}

struct LaneTerms {
  Lanes h, solid_angle;
  Lanes r[3];                                        ///< distances of the corners
  Lanes p[3], f[3], rise[3], s0[3], s1[3], part[3];  ///< per edge; R₊−R₋; ends; share of Ω
};

CONCHOID_INTO_CLONES void find_terms(const Numbers& q, const Lanes (&x)[3], LaneTerms& e) {
  Lanes to[3][3], (&r)[3] = e.r;
  for (int i = 0; i < 3; ++i)
    from_to(x, q.corner[i], to[i], r[i]);
  const Lanes zero = {};
  const IntLanes first = (IntLanes)(r[0] <= r[1]) & (IntLanes)(r[0] <= r[2]);
  const IntLanes second = (IntLanes)(r[1] <= r[2]);
  Lanes nearest[3];
  for (int k = 0; k < 3; ++k)
    nearest[k] = first ? to[0][k] : second ? to[1][k] : to[2][k];
  dot(q.normal, nearest, e.h);
  Lanes height = e.h;
  take_absolute(height);
  const IntLanes above = (IntLanes)(height > q.noise);
  e.h = above ? -e.h : zero;
  height = above ? height : zero;
  e.solid_angle = zero;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    Lanes &s0 = e.s0[i], &s1 = e.s1[i], end[3];
    dot(q.along[i], to[i], s0);
    dot(q.along[i], to[j], s1);
    const IntLanes start = (IntLanes)(r[i] <= r[j]);
    for (int k = 0; k < 3; ++k)
      end[k] = start ? to[i][k] : to[j][k];
    Lanes p;
    dot(q.outward[i], end, p);
    const Lanes d2 = p * p + e.h * e.h;
    log_term(s0, s1, r[i], r[j], q.length[i], d2, e.f[i]);
    e.p[i] = p;
    e.rise[i] = q.length[i] * (s0 + s1) / (r[i] + r[j]);
    const Lanes d0 = d2 + height * r[i], d1 = d2 + height * r[j];
    angle_of(p * (s1 * d0 - s0 * d1), d0 * d1 + p * p * s0 * s1, e.part[i]);
    e.solid_angle += e.part[i];
  }
  e.solid_angle = above ? e.solid_angle : zero;
}

CONCHOID_INTO_CLONES void store(double (&to)[Points::most], int j, const Lanes& value) {
  reinterpret_cast<Lanes*>(to)[j] = value;
}

/// Ω with the sign of h.
CONCHOID_INTO_CLONES void take_side(const LaneTerms& e, Lanes& omega) {
  omega = e.h < 0 ? -e.solid_angle : e.solid_angle;
}

CONCHOID_WIDE_CLONES void panel_single_layer(const Numbers& q, const Points& points, PointValues<7>& result) {
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3];
    load(points, j, x);
    LaneTerms e;
    find_terms(q, x, e);
    Lanes height = e.h;
    take_absolute(height);
    const Lanes cap = height * e.solid_angle;
    Lanes potential = -cap, force[2] = {}, t00 = {}, t11 = {}, t01 = {};
    for (int i = 0; i < 3; ++i) {
      const double m0 = q.m[i][0], m1 = q.m[i][1], s0 = q.t[i][0], s1 = q.t[i][1];
      const Lanes pf = e.p[i] * e.f[i];
      potential += pf;
      force[0] += m0 * e.f[i];
      force[1] += m1 * e.f[i];
      const Lanes c0 = m0 * pf + s0 * e.rise[i], c1 = m1 * pf + s1 * e.rise[i];
      t00 -= m0 * c0;
      t11 -= m1 * c1;
      t01 -= 0.5 * (m0 * c1 + m1 * c0);
    }
    store(result.of[0], j, potential);
    store(result.of[1], j, t00 + potential);
    store(result.of[2], j, t11 + potential);
    store(result.of[3], j, cap);
    store(result.of[4], j, e.h * force[1]);
    store(result.of[5], j, e.h * force[0]);
    store(result.of[6], j, t01);
  }
}

CONCHOID_WIDE_CLONES void panel_double_layer(const Numbers& q, const Points& points, PointValues<3>& result) {
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3], omega, force[2] = {};
    load(points, j, x);
    LaneTerms e;
    find_terms(q, x, e);
    take_side(e, omega);
    for (int i = 0; i < 3; ++i) {
      force[0] += q.m[i][0] * e.f[i];
      force[1] += q.m[i][1] * e.f[i];
    }
    for (int c = 0; c < 3; ++c) {
      const int i = (c + 1) % 3;
      store(result.of[c], j,
            (e.p[i] * omega + e.h * (q.m[i][0] * force[0] + q.m[i][1] * force[1])) / q.height[i]);
    }
  }
}

/// @param along_normal, along_edges  a·n and a·m of the edges
CONCHOID_WIDE_CLONES void panel_gradient(const Numbers& q, double along_normal,
                                         const double (&along_edges)[3], const Points& points,
                                         PointValues<1>& result) {
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3], omega;
    load(points, j, x);
    LaneTerms e;
    find_terms(q, x, e);
    take_side(e, omega);
    store(result.of[0], j,
          -(along_normal * omega + along_edges[0] * e.f[0] + along_edges[1] * e.f[1] +
            along_edges[2] * e.f[2]));
  }
}

/// With s along an edge, d² = p² + h²:
///   ∫_f R = ½ (d² f + [s R]) ,  ∫_f log(R+|h|) = [s log(R+|h|)] − L + |h| f + p Ω_f ,
///   ∫_Y log(R+|h|) = Σ ½ p ∫_f log(R+|h|) − ¼ (p L − 2 |h| p f + 2 h² Ω_f)
CONCHOID_WIDE_CLONES void panel_contour(const Numbers& q, double D, const Points& points,
                                        PointValues<6>& result) {
  const Lanes zero = {};
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3], log_at[3];
    load(points, j, x);
    LaneTerms e;
    find_terms(q, x, e);
    Lanes height = e.h;
    take_absolute(height);
    for (int i = 0; i < 3; ++i) {
      const Lanes sum = e.r[i] + height;
      log_of_ratio(sum, zero + D, sum < zero, zero, zero + 1.0, log_at[i]);
      log_at[i] = sum > smallest ? log_at[i] : zero;
    }
    Lanes a[2] = {}, b[2] = {}, potential = {}, moment = {};
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3;
      const Lanes p = e.p[i], f = e.f[i], d2 = p * p + e.h * e.h;
      const Lanes of_r = 0.5 * (d2 * f + e.s1[i] * e.r[k] - e.s0[i] * e.r[i]);
      const Lanes part = height > 0 ? e.part[i] : zero;
      const Lanes of_log = e.s1[i] * log_at[k] - e.s0[i] * log_at[i] - q.length[i] + height * f + p * part;
      for (int c = 0; c < 2; ++c) {
        a[c] += q.m[i][c] * of_r;
        b[c] += q.m[i][c] * of_log;
      }
      potential += p * f - height * part;
      moment += 0.5 * p * of_log - 0.25 * (p * q.length[i] - 2 * height * p * f + 2 * height * height * part);
    }
    store(result.of[0], j, a[0]);
    store(result.of[1], j, a[1]);
    store(result.of[2], j, b[0]);
    store(result.of[3], j, b[1]);
    store(result.of[4], j, potential);
    store(result.of[5], j, moment);
  }
}

struct LineNumbers {
  double a[3], b[3], along[3], length;

  LineNumbers(const Vec3& from, const Vec3& to) {
    const Vec3 ab = to - from;
    length = ab.norm();
    for (int k = 0; k < 3; ++k) {
      a[k] = from[k];
      b[k] = to[k];
      along[k] = ab[k] / length;
    }
  }
};

struct LaneLine {
  Lanes offset[3], d2, s0, inverse_rise, f, cube;  ///< as LineTerms, and ∫1/R, ∫1/R³
};

CONCHOID_INTO_CLONES void find_line(const LineNumbers& q, const Lanes (&x)[3], LaneLine& e) {
  const Lanes zero = {};
  Lanes to_a[3], to_b[3], r0, r1, s1;
  from_to(x, q.a, to_a, r0);
  from_to(x, q.b, to_b, r1);
  dot(q.along, to_a, e.s0);
  dot(q.along, to_b, s1);
  const IntLanes start = (IntLanes)(r0 <= r1);
  for (int k = 0; k < 3; ++k)
    e.offset[k] = start ? e.s0 * q.along[k] - to_a[k] : s1 * q.along[k] - to_b[k];
  e.d2 = e.offset[0] * e.offset[0] + e.offset[1] * e.offset[1] + e.offset[2] * e.offset[2];
  log_term(e.s0, s1, r0, r1, q.length, e.d2, e.f);
  const Lanes inverse0 = r0 > 0 ? 1 / r0 : zero, inverse1 = r1 > 0 ? 1 / r1 : zero;
  e.inverse_rise = inverse1 - inverse0;
  const Lanes outside = q.length * (e.s0 + s1) / (r0 * r1 * (s1 * r0 + e.s0 * r1));
  const Lanes inside = (s1 * inverse1 - e.s0 * inverse0) / e.d2;
  e.cube = e.s0 * s1 > 0 ? outside : e.d2 > 0 ? inside : zero;
}

CONCHOID_WIDE_CLONES void segment_single_layer(const LineNumbers& q, const Points& points,
                                               PointValues<7>& result) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3], other[3];
    load(points, j, x);
    LaneLine e;
    find_line(q, x, e);
    for (int k = 0; k < 3; ++k)
      other[k] = e.cube * e.offset[k] + (2 * q.along[k]) * e.inverse_rise;
    const Lanes rest = e.f - e.cube * e.d2;
    store(result.of[0], j, e.f);
    for (int k = 0; k < 6; ++k)
      store(result.of[k + 1], j,
            0.5 * (e.offset[row[k]] * other[column[k]] + e.offset[column[k]] * other[row[k]]) +
                (q.along[row[k]] * q.along[column[k]]) * rest);
  }
}

CONCHOID_WIDE_CLONES void segment_field(const LineNumbers& q, const double (&n)[3], double n_along,
                                        const Points& points, PointValues<2>& result) {
  for (int j = 0; j < points.padded / lanes; ++j) {
    Lanes x[3], n_offset;
    load(points, j, x);
    LaneLine e;
    find_line(q, x, e);
    dot(n, e.offset, n_offset);
    const Lanes first = -e.inverse_rise, second = e.f - e.cube * e.d2;
    store(result.of[0], j, e.cube * n_offset - first * n_along);
    store(result.of[1], j,
          ((first - e.s0 * e.cube) * n_offset - (second - e.s0 * first) * n_along) / q.length);
  }
}

}  // namespace

PointPotentials::PointPotentials(const PanelPotential& panel) {
  axes_ << panel.edge_direction(0), panel.edge_normal(0), panel.normal();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      q_.corner[i][k] = panel.corner(i)[k];
      q_.along[i][k] = panel.edge_direction(i)[k];
      q_.outward[i][k] = panel.edge_normal(i)[k];
      q_.normal[k] = panel.normal()[k];
    }
    for (int k = 0; k < 2; ++k) {
      q_.m[i][k] = axes_.col(k).dot(panel.edge_normal(i));
      q_.t[i][k] = axes_.col(k).dot(panel.edge_direction(i));
    }
    q_.length[i] = panel.edge_length(i);
    q_.height[i] = panel.double_area() / panel.edge_length(i);
  }
  q_.noise = panel.noise();
}

void PointPotentials::single_layer(const Points& x, PointValues<7>& result) const {
  panel_single_layer(q_, x, result);
}

Family PointPotentials::in_space(const Family& f) const {
  Mat3 own;
  own << f[1], f[6], f[5], f[6], f[2], f[4], f[5], f[4], f[3];
  const Mat3 turned = axes_ * own * axes_.transpose();
  Family result;
  result << f[0], turned(0, 0), turned(1, 1), turned(2, 2), turned(1, 2), turned(0, 2), turned(0, 1);
  return result;
}

void PointPotentials::double_layer(const Points& x, PointValues<3>& result) const {
  panel_double_layer(q_, x, result);
}

void PointPotentials::gradient_along(const Vec3& a, const Points& x, PointValues<1>& result) const {
  double edges[3];
  for (int i = 0; i < 3; ++i)
    edges[i] = q_.outward[i][0] * a[0] + q_.outward[i][1] * a[1] + q_.outward[i][2] * a[2];
  panel_gradient(q_, axes_.col(2).dot(a), edges, x, result);
}

void PointPotentials::contour(const Points& x, double D, PointValues<6>& result) const {
  panel_contour(q_, D, x, result);
}

void line_single_layer(const Points& x, const Vec3& a, const Vec3& b, PointValues<7>& result) {
  segment_single_layer(LineNumbers(a, b), x, result);
}

void line_field_along(const Vec3& n, const Points& x, const Vec3& a, const Vec3& b, PointValues<2>& result) {
  const LineNumbers q(a, b);
  const double components[3] = {n[0], n[1], n[2]};
  segment_field(q, components, n[0] * q.along[0] + n[1] * q.along[1] + n[2] * q.along[2], x, result);
}

}  // namespace conchoid
