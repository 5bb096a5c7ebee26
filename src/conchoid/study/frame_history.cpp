#include "conchoid/study/frame_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conchoid {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Rows = std::vector<const FrontRow*>;

std::map<int, Rows> rows_by_frame(const std::vector<FrontRow>& rows) {
  std::map<int, Rows> frames;
  for (const FrontRow& row : rows)
    frames[row.frame].push_back(&row);
  return frames;
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double s = length2 > 0 ? std::clamp((x - a).dot(d) / length2, 0.0, 1.0) : 0;
  return (x - a - s * d).norm();
}

// To the lines through points that follow each other on one front. Gaps many times the usual distance are no
// part of it: the front is outside of the body there.
double distance_to_front(const Vec3& x, const Rows& front) {
  constexpr double longest = 4;  // × the median distance of neighbours
  std::vector<double> lengths;
  for (std::size_t i = 1; i < front.size(); ++i)
    if (front[i]->front == front[i - 1]->front)
      lengths.push_back((front[i]->position - front[i - 1]->position).norm());
  double limit = 0;
  if (!lengths.empty()) {
    std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                     lengths.end());
    limit = longest * lengths[lengths.size() / 2];
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < front.size(); ++i) {
    nearest = std::min(nearest, (x - front[i]->position).norm());
    if (i == 0 || front[i]->front != front[i - 1]->front) continue;
    const Vec3 &p = front[i - 1]->position, &q = front[i]->position;
    if ((q - p).norm() <= limit) nearest = std::min(nearest, distance_to_segment(x, p, q));
  }
  return nearest;
}

double mean_distance(const Rows& from, const Rows& to) {
  double sum = 0;
  for (const FrontRow* row : from)
    sum += distance_to_front(row->position, to);
  return sum / static_cast<double>(from.size());
}

Rows moving(const Rows& rows) {
  Rows out;
  for (const FrontRow* row : rows)
    if (row->speed > 0) out.push_back(row);
  return out;
}

double squared_kink_difference(const Rows& from, const Rows& to) {
  double sum = 0;
  for (const FrontRow* row : from) {
    const FrontRow* nearest = *std::min_element(to.begin(), to.end(), [&](const auto* p, const auto* q) {
      return (p->position - row->position).squaredNorm() < (q->position - row->position).squaredNorm();
    });
    sum += std::pow(row->kink_angle - nearest->kink_angle, 2);
  }
  return sum / static_cast<double>(from.size());
}

double kink_difference(const Rows& a, const Rows& b) {
  const Rows moving_a = moving(a), moving_b = moving(b);
  if (moving_a.empty() || moving_b.empty()) return kNone;
  return std::sqrt(
      0.5 * (squared_kink_difference(moving_a, moving_b) + squared_kink_difference(moving_b, moving_a)));
}

double crack_area(const RunData& run, int frame) {
  for (const FrameRecord& record : run.document.timings)
    if (record.frame == frame) return record.crack_area > 0 ? record.crack_area : kNone;
  return kNone;
}

}  // namespace

std::map<int, FrontAverage> front_averages(const std::vector<FrontRow>& rows) {
  std::map<int, FrontAverage> frames;
  for (const FrontRow& row : rows) {
    FrontAverage& f = frames[row.frame];
    f.intensity += row.intensity.cwiseAbs();
    f.length += row.intensity.norm();
    ++f.points;
  }
  for (auto& [number, f] : frames) {
    f.intensity /= static_cast<double>(f.points);
    f.length /= static_cast<double>(f.points);
  }
  return frames;
}

std::vector<FrameComparison> compare_frames(const RunData& a, const RunData& b) {
  const auto averages_a = front_averages(a.front), averages_b = front_averages(b.front);
  const auto rows_a = rows_by_frame(a.front), rows_b = rows_by_frame(b.front);
  std::vector<FrameComparison> out;
  for (const auto& [frame, front_a] : rows_a) {
    const auto found = rows_b.find(frame);
    if (found == rows_b.end()) continue;
    const Rows& front_b = found->second;
    FrameComparison c;
    c.frame = frame;
    c.crack_area = {crack_area(a, frame), crack_area(b, frame)};
    c.intensity = {averages_a.at(frame).intensity, averages_b.at(frame).intensity};
    c.front_distance = 0.5 * (mean_distance(front_a, front_b) + mean_distance(front_b, front_a));
    c.kink_angle = kink_difference(front_a, front_b);
    out.push_back(c);
  }
  return out;
}

}  // namespace conchoid
