#include "conchoid/crack/fine/marker_curve.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

std::unordered_map<NodeId, std::size_t> places(const std::vector<NodeId>& coarse) {
  std::unordered_map<NodeId, std::size_t> place;
  for (std::size_t k = 0; k < coarse.size(); ++k)
    place.emplace(coarse[k], k);
  return place;
}

/// Markers with a coarse node attached, in order.
std::vector<std::size_t> markers_with_node(const MarkerCurve& curve) {
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
  const auto stops = markers_with_node(curve);
  if (stops.empty()) return;
  const std::size_t n = curve.size();
  const auto period = static_cast<double>(coarse.size());
  const auto place_of = [&](std::size_t r) {
    const auto at = place.find(curve.markers[stops[r]].coarse);
    if (at == place.end())
      throw ComputationError("the markers of a crack front have lost the coarse nodes they are attached to");
    return at->second;
  };
  const auto of = [&](std::size_t r) {
    return static_cast<double>(place_of(r)) + curve.markers[stops[r]].offset;
  };
  for (std::size_t r = 0; r < stops.size(); ++r) {
    const std::size_t after = r + 1 < stops.size() ? r + 1 : 0;
    const bool tail = after == 0 && !curve.closed;
    const std::size_t count = tail ? n - stops[r] : (stops[after] + n - stops[r] - 1) % n + 1;
    const double round = place_of(after) <= place_of(r) && curve.closed ? period : 0.0;
    const double from = of(r), to = tail ? from : std::max(from, of(after) + round);
    double total = 0, arc = 0;
    for (std::size_t k = 0, i = stops[r]; k < count; ++k, i = curve.next(i))
      total += curve.spacing(i);
    for (std::size_t k = 0, i = stops[r]; k < count; ++k, i = curve.next(i)) {
      double& parameter = curve.markers[i].parameter;
      parameter = from + (total > 0 ? (to - from) * arc / total : 0.0);
      if (curve.closed) parameter -= period * std::floor(parameter / period);
      arc += curve.spacing(i);
    }
  }
  if (!curve.closed) return;
  const auto first =
      std::min_element(curve.markers.begin(), curve.markers.end(),
                       [](const Marker& x, const Marker& y) { return x.parameter < y.parameter; });
  std::rotate(curve.markers.begin(), first, curve.markers.end());
}

void reattach_nodes(MarkerCurve& curve, const std::vector<NodeId>& coarse,
                    const IdVector<NodeId, Vec3>& positions) {
  const auto place = places(coarse);
  const auto off = [&](std::size_t i, const Vec3& x) { return (curve.markers[i].position - x).norm(); };
  for (std::size_t stop : markers_with_node(curve)) {
    const NodeId node = curve.markers[stop].coarse;
    const Vec3& x = positions[node];
    std::size_t i = stop;
    for (const bool forward : {true, false}) {
      const auto step = [&](std::size_t at) { return forward ? curve.next(at) : curve.previous(at); };
      for (std::size_t to = step(i); !curve.markers[to].coarse.valid() && off(to, x) < off(i, x);
           to = step(to))
        i = to;
    }
    const bool end = !curve.closed && (stop == 0 || stop + 1 == curve.size());
    if (end) i = stop;
    curve.markers[stop].coarse = NodeId();
    curve.markers[i].coarse = node;
    const Vec3 along = curve.markers[curve.next(i)].position - curve.markers[curve.previous(i)].position;
    const double arc = (curve.markers[i].position - x).dot(along.normalized());
    const std::size_t k = place.at(node);
    const std::size_t other =
        arc > 0 ? next_index(k, coarse.size(), curve.closed) : previous_index(k, coarse.size(), curve.closed);
    const double edge = (positions[coarse[other]] - x).norm();
    curve.markers[i].offset =
        end || !(edge > 0) ? 0.0 : std::clamp(arc / edge, -kMarkerOffset, kMarkerOffset);
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
        std::abs(off - least) <= kEqualArc * total;  // the same choice whichever way the front is walked
    if (tie ? curve.markers[i].node < curve.markers[best].node : off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

void slide_attached_nodes(MarkerCurve& curve, const std::vector<NodeId>& coarse,
                          const std::vector<bool>& may_slide) {
  const auto place = places(coarse);
  const auto stops = markers_with_node(curve);
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
  std::vector<NodeId> attached;
  for (std::size_t stop : stops) {
    attached.push_back(curve.markers[stop].coarse);
    curve.markers[stop].coarse = NodeId();
  }
  for (std::size_t r = 0; r < n; ++r)
    curve.markers[to[r]].coarse = attached[r];
}

}  // namespace conchoid
