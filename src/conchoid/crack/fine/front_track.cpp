#include "conchoid/crack/fine/front_track.hpp"

#include <algorithm>

namespace conchoid {

void FrontTrack::add(double time, const MarkerCurve& curve, const std::vector<Vec3>& smoothed,
                     std::size_t coarse_nodes) {
  if (curve.size() == 0) return;
  period_ = curve.closed ? static_cast<double>(coarse_nodes) : 0.0;
  Row row;
  row.time = time;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    row.parameter.push_back(curve.markers[i].parameter);
    row.position.push_back(smoothed[i]);
  }
  rows_.push_back(std::move(row));
}

Vec3 FrontTrack::at(double parameter, double time) const {
  const auto later =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.time >= time; });
  if (later == rows_.end()) return point(rows_.back(), parameter);
  if (later == rows_.begin()) return point(*later, parameter);
  const Row& earlier = *std::prev(later);
  const double s = (time - earlier.time) / (later->time - earlier.time);
  return (1 - s) * point(earlier, parameter) + s * point(*later, parameter);
}

Vec3 FrontTrack::point(const Row& row, double parameter) const {
  const auto& p = row.parameter;
  const std::size_t n = p.size();
  const auto after = static_cast<std::size_t>(std::upper_bound(p.begin(), p.end(), parameter) - p.begin());
  const bool outside = after == 0 || after == n;
  if (outside && period_ == 0) return row.position[after == 0 ? 0 : n - 1];
  const std::size_t a = after == 0 ? n - 1 : after - 1, b = after == n ? 0 : after;
  const double low = p[a] - (after == 0 ? period_ : 0.0), high = p[b] + (after == n ? period_ : 0.0);
  const double s = high > low ? std::clamp((parameter - low) / (high - low), 0.0, 1.0) : 0.0;
  return (1 - s) * row.position[a] + s * row.position[b];
}

}  // namespace conchoid
