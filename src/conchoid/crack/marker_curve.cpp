#include "conchoid/crack/marker_curve.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "conchoid/crack/front_frames.hpp"

namespace conchoid {

namespace {

constexpr double kSlide = 0.25;  ///< share of the way to the middle of its neighbours a coarse node slides …
constexpr double kSlideFrom = 0.2;  ///< … where its two edges differ by more than this share of their sum

constexpr double kTie = 1e-6;  ///< of the arc: markers equally near

std::unordered_map<NodeId, std::size_t> places(const std::vector<NodeId>& coarse) {
  std::unordered_map<NodeId, std::size_t> place;
  for (std::size_t k = 0; k < coarse.size(); ++k)
    place.emplace(coarse[k], k);
  return place;
}

/// Markers that carry a coarse node, in order.
std::vector<std::size_t> riders(const MarkerCurve& curve) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.markers[i].coarse.valid()) found.push_back(i);
  return found;
}

double arc_length(const MarkerCurve& curve, std::size_t a, std::size_t b) {
  double length = 0;
  for (std::size_t i = a; i != b; i = curve.next(i))
    length += curve.spacing(i);
  return length;
}

/// Marker nearest to the place `distance` along the curve from marker i (backwards if negative).
std::size_t marker_at_distance(const MarkerCurve& curve, std::size_t i, double distance) {
  double left = std::abs(distance);
  while (left > 0) {
    const std::size_t to = distance > 0 ? curve.next(i) : curve.previous(i);
    const double step = curve.spacing(distance > 0 ? i : to);
    if (to == i || left < 0.5 * step) break;
    left -= step;
    i = to;
  }
  return i;
}

}  // namespace

std::size_t MarkerCurve::next(std::size_t i) const {
  return next_index(i, size(), closed);
}
std::size_t MarkerCurve::previous(std::size_t i) const {
  return previous_index(i, size(), closed);
}
double MarkerCurve::spacing(std::size_t i) const {
  return (markers[next(i)].position - markers[i].position).norm();
}

void set_parameters(MarkerCurve& curve, const std::vector<NodeId>& coarse) {
  const auto place = places(coarse);
  const auto of = [&](std::size_t i) { return place.at(curve.markers[i].coarse); };
  const auto carrying = riders(curve);
  if (carrying.empty()) return;
  if (curve.closed) {
    const std::size_t lead = *std::min_element(carrying.begin(), carrying.end(),
                                               [&](std::size_t x, std::size_t y) { return of(x) < of(y); });
    std::rotate(curve.markers.begin(), curve.markers.begin() + static_cast<std::ptrdiff_t>(lead),
                curve.markers.end());
  }
  const auto stops = riders(curve);
  for (std::size_t r = 0; r < stops.size(); ++r) {
    const bool last = r + 1 == stops.size();
    const std::size_t begin = stops[r], end = last ? curve.size() : stops[r + 1];
    const auto from = static_cast<double>(of(begin));
    const auto to = static_cast<double>(last ? coarse.size() + of(stops[0]) : of(end));
    double total = 0, arc = 0;
    for (std::size_t i = begin; i < end; ++i)
      total += curve.spacing(i);
    for (std::size_t i = begin; i < end; arc += curve.spacing(i), ++i)
      curve.markers[i].parameter = from + (total > 0 ? (to - from) * arc / total : 0.0);
  }
}

Vec3 point_at(const MarkerCurve& curve, double parameter, std::size_t coarse_nodes) {
  const std::size_t n = curve.size();
  const auto period = static_cast<double>(coarse_nodes);
  if (parameter < curve.markers.front().parameter) parameter += period;
  for (std::size_t i = 0; i < edge_count(n, curve.closed); ++i) {
    const Marker &a = curve.markers[i], &b = curve.markers[curve.next(i)];
    const double high = i + 1 == n ? b.parameter + period : b.parameter;
    if (parameter < a.parameter || parameter > high) continue;
    const double s = high > a.parameter ? (parameter - a.parameter) / (high - a.parameter) : 0.0;
    return (1 - s) * a.position + s * b.position;
  }
  return curve.markers.back().position;
}

std::size_t marker_between(const MarkerCurve& curve, std::size_t a, std::size_t b, double s, bool ends) {
  const double total = arc_length(curve, a, b);
  std::size_t best = a;
  double arc = 0, least = ends ? s * total : 2 * total;
  for (std::size_t i = a; i != b;) {
    arc += curve.spacing(i);
    i = curve.next(i);
    if (i == b && !ends) break;
    const double off = std::abs(arc - s * total);
    const bool tie =
        std::abs(off - least) <= kTie * total;  // the same choice whichever way the front is walked
    if (tie ? curve.markers[i].node < curve.markers[best].node : off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

void slide_riders(MarkerCurve& curve, const std::vector<NodeId>& coarse, const std::vector<bool>& may_slide) {
  const auto place = places(coarse);
  const auto stops = riders(curve);
  const std::size_t n = stops.size();
  if (n < 3) return;
  std::vector<std::size_t> to = stops;
  for (std::size_t r = 0; r < n; ++r) {
    if (!curve.closed && (r == 0 || r + 1 == n)) continue;
    if (!may_slide[place.at(curve.markers[stops[r]].coarse)]) continue;
    const double before = arc_length(curve, stops[(r + n - 1) % n], stops[r]);
    const double after = arc_length(curve, stops[r], stops[(r + 1) % n]);
    if (std::abs(after - before) <= kSlideFrom * (after + before)) continue;
    to[r] = marker_at_distance(curve, stops[r], kSlide * 0.5 * (after - before));
  }
  std::vector<NodeId> carried;
  for (std::size_t stop : stops) {
    carried.push_back(curve.markers[stop].coarse);
    curve.markers[stop].coarse = NodeId();
  }
  for (std::size_t r = 0; r < n; ++r)
    curve.markers[to[r]].coarse = carried[r];
}

}  // namespace conchoid
