#include "conchoid/crack/fine/front_smoothing.hpp"

#include <algorithm>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// Distance along the curve from marker i to its nearer end, at most `most`; of a ring a half of its length.
double room(const MarkerCurve& curve, std::size_t i, double most) {
  double least = most;
  for (const bool forward : {true, false}) {
    double arc = 0;
    std::size_t k = i;
    while (arc < least) {
      const std::size_t to = forward ? curve.next(k) : curve.previous(k);
      if (to == k) {
        least = arc;
        break;
      }
      arc += curve.spacing(forward ? k : to);
      k = to;
      if (k == i) {  // once round
        least = std::min(least, arc / 2);
        break;
      }
    }
  }
  return least;
}

double weight(double s, double width) {
  return (4 * std::max(0.0, 1 - s / width) - std::max(0.0, 1 - s / (2 * width)) / 2) / 3;
}

}  // namespace

Vec3 smoothed_position(const MarkerCurve& curve, std::size_t i, double width) {
  const double w = room(curve, i, 2 * width) / 2;
  if (!(w > 0)) return curve.markers[i].position;
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const bool forward : {true, false}) {  // trapezoidal rule, on each side from marker i
    double arc = 0;
    std::size_t k = i;
    while (arc < 2 * w) {
      const std::size_t to = forward ? curve.next(k) : curve.previous(k);
      if (to == k) break;
      const double length = curve.spacing(forward ? k : to);
      const double a = 0.5 * length * weight(arc, w), b = 0.5 * length * weight(arc + length, w);
      sum += a * (curve.markers[k].position - curve.markers[i].position) +
             b * (curve.markers[to].position - curve.markers[i].position);
      total += a + b;
      arc += length;
      k = to;
    }
  }
  return total > 0 ? Vec3(curve.markers[i].position + sum / total) : curve.markers[i].position;
}

std::vector<Vec3> smoothed_positions(const MarkerCurve& curve, double width) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < curve.size(); ++i)
    out.push_back(smoothed_position(curve, i, width));
  return out;
}

void smooth_along(const MarkerCurve& curve, const std::vector<bool>& takes_part,
                  std::vector<double>& values) {
  for (int pass = 0; pass < kDeflectionPasses; ++pass) {
    const std::vector<double> old = values;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const std::size_t a = curve.previous(i), b = curve.next(i);
      if (takes_part[a] && takes_part[i] && takes_part[b])
        values[i] = 0.5 * old[i] + 0.25 * (old[a] + old[b]);
    }
  }
}

}  // namespace conchoid
