#include "conchoid/quadrature/point_quadrature.hpp"

#include "conchoid/quadrature/cells.hpp"
#include "conchoid/quadrature/lanes.hpp"

namespace conchoid {

namespace {

/// Beyond this share of the segment's length a Kronrod rule follows the peak without help.
constexpr double felt = 0.1;
/// Places closer than this are one.
constexpr double same_place = 1e-3;

CONCHOID_WIDE_CLONES void weigh_lanes(const double (*values)[Points::most], const double* stretch,
                                      const KronrodPoints& rule, int n, double (*sums)[2][lanes],
                                      double (&size)[lanes]) {
  constexpr int blocks = Points::most / lanes;
  Lanes weight[blocks], gauss[blocks], largest[blocks] = {};
  for (int j = 0; j < blocks; ++j) {
    const Lanes slope = reinterpret_cast<const Lanes*>(stretch)[j];
    weight[j] = slope * reinterpret_cast<const Lanes*>(rule.weight)[j];
    gauss[j] = slope * reinterpret_cast<const Lanes*>(rule.gauss_weight)[j];
  }
  for (int k = 0; k < n; ++k) {
    Lanes high = {}, low = {};
    for (int j = 0; j < blocks; ++j) {
      Lanes v = reinterpret_cast<const Lanes*>(values[k])[j];
      high += weight[j] * v;
      low += gauss[j] * v;
      take_absolute(v);
      largest[j] = v > largest[j] ? v : largest[j];
    }
    for (int l = 0; l < lanes; ++l) {
      sums[k][0][l] = high[l];
      sums[k][1][l] = high[l] - low[l];
    }
  }
  Lanes total = {};
  for (int j = 0; j < blocks; ++j)
    total += weight[j] * largest[j];
  for (int l = 0; l < lanes; ++l)
    size[l] = total[l];
}

/// A place of one segment, and how far from it the other comes there.
struct Approach {
  double at, distance;
};

/// Of the segment from a to b to that from c to d.
Approach closest_approach(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = c - a;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  const double unbounded = det > 0 ? std::clamp((uw * vv - vw * uv) / det, 0.0, 1.0) : 0.0;
  const double along = std::clamp((unbounded * uv - vw) / vv, 0.0, 1.0);
  const double at = std::clamp((along * uv + uw) / uu, 0.0, 1.0);
  return {at, (w + along * v - at * u).norm()};
}

void add_edge(SteepPlaces& places, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (cross(b - a, d - c).squaredNorm() < 1e-4 * (b - a).squaredNorm() * (d - c).squaredNorm()) {
    // Side by side: the ends are what is steep.
    for (const Vec3& end : {c, d}) {
      const double at = (b - a).dot(end - a) / (b - a).squaredNorm();
      if (distance_to_segment(end, a, b) < felt * (b - a).norm()) places.add(std::clamp(at, 0.0, 1.0));
    }
    return;
  }
  const Approach approach = closest_approach(a, b, c, d);
  if (approach.distance < felt * (b - a).norm()) places.add(approach.at);
}

}  // namespace

const KronrodPoints& kronrod_points() {
  static const KronrodPoints points = [] {
    KronrodPoints p{};
    for (std::size_t i = 0; i < 8; ++i) {
      p.node[i] = 0.5 - 0.5 * KronrodRule::node[i];
      p.node[14 - i] = 0.5 + 0.5 * KronrodRule::node[i];
      p.weight[i] = p.weight[14 - i] = 0.5 * KronrodRule::weight[i];
      p.gauss_weight[i] = p.gauss_weight[14 - i] = 0.5 * KronrodRule::gauss_weight[i];
    }
    p.node[15] = p.node[14];
    return p;
  }();
  return points;
}

Weighed weigh(const double (*values)[Points::most], const Parameters& stretch, int n, double* integrals) {
  alignas(32) double sums[most_values][2][lanes], size[lanes];
  weigh_lanes(values, stretch, kronrod_points(), n, sums, size);
  double difference = 0;
  for (int k = 0; k < n; ++k) {
    integrals[k] = sum_lanes(sums[k][0]);
    difference = std::max(difference, std::abs(sum_lanes(sums[k][1])));
  }
  return {difference, sum_lanes(size)};
}

void SteepPlaces::add(double s) {
  if (!(s > same_place)) {
    steep_start_ = steep_start_ || s >= 0;
    return;
  }
  if (!(s < 1 - same_place)) {
    steep_end_ = steep_end_ || s <= 1;
    return;
  }
  int i = 0;
  for (; i < count_; ++i) {
    const double other = at_[static_cast<std::size_t>(i)];
    if (std::abs(other - s) < same_place) return;
    if (other > s) break;
  }
  if (count_ == static_cast<int>(at_.size())) return;
  for (int j = count_++; j > i; --j)
    at_[static_cast<std::size_t>(j)] = at_[static_cast<std::size_t>(j - 1)];
  at_[static_cast<std::size_t>(i)] = s;
}

void SteepPlaces::Piece::stretch(const Parameters& t, Parameters& s, Parameters& slope) const {
  const double length = to - from;
  for (int i = 0; i < Points::most; ++i) {
    const double x = t[i], y = 1 - x;
    if (steep_from && steep_to) {
      s[i] = from + length * x * x * x * (1 + 3 * y + 6 * y * y);
      slope[i] = length * 30 * x * x * y * y;
    } else if (steep_from) {
      s[i] = from + length * x * x * x;
      slope[i] = length * 3 * x * x;
    } else if (steep_to) {
      s[i] = to - length * y * y * y;
      slope[i] = length * 3 * y * y;
    } else {
      s[i] = from + length * x;
      slope[i] = length;
    }
  }
}

SteepPlaces steep_places(const Vec3& a, const Vec3& b, const PanelPotential& panel) {
  SteepPlaces places;
  const double ha = panel.height(a), hb = panel.height(b);
  if ((ha < 0) != (hb < 0)) {
    const double s = ha / (ha - hb);
    if (distance_to_panel((1 - s) * a + s * b, panel) < felt * (b - a).norm()) places.add(s);
  }
  for (int i = 0; i < 3; ++i)
    add_edge(places, a, b, panel.corner(i), panel.corner((i + 1) % 3));
  return places;
}

SteepPlaces steep_places(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  SteepPlaces places;
  add_edge(places, a, b, c, d);
  return places;
}

}  // namespace conchoid
