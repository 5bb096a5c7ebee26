#include "conchoid/sim/expected_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/sim/ligament_rule.hpp"

namespace conchoid {
namespace {

constexpr double kForgetting = 0.5;  // share of the last comparison in the scale

// By which the front turns.
double turn_of(const Vec3& K, double crack_edge, const ElasticConstants& m) {
  return opens_beyond_elasticity(K, crack_edge, m) ? 0 : kink_angle(K, m);
}

}  // namespace

double stated_angle_error(const FrontOpening& predicted, double crack_edge, const ElasticConstants& m) {
  double error = std::abs(turn_of(predicted.intensity, crack_edge, m));
  if (!predicted.spread.isZero(0) && !opens_beyond_elasticity(predicted.intensity, crack_edge, m)) {
    double variance = 0;
    for (int mode = 0; mode < 3; ++mode) {
      const Vec3 more = predicted.intensity + predicted.spread[mode] * Vec3::Unit(mode);
      const Vec3 less = predicted.intensity - predicted.spread[mode] * Vec3::Unit(mode);
      const double turn = 0.5 * (kink_angle(more, m) - kink_angle(less, m));
      variance += turn * turn;
    }
    error = std::sqrt(variance);
  }
  return std::max(error, predicted.in_range ? kLeastAngleError : kOutsideAngleError);
}

ExpectedError::Deviation ExpectedError::deviation(const FrontPoint& point) const {
  if (const auto still = at_.find(point.node); still != at_.end()) return still->second.before;
  if (const auto grown = at_.find(point.correlation); grown != at_.end()) return grown->second.after;
  return {};
}

ExpectedError::Deviation ExpectedError::after_error(const Deviation& before, double error) const {
  const double kept = statement_.persistence * error;
  Deviation after = before;
  after.angle = std::sqrt(before.angle * before.angle + 2 * kept * before.angle + error * error);
  if (before.angle > 0) after.both *= 1 + kept / before.angle;
  const double across = crack_edge_ * std::sin(std::min(after.angle, std::numbers::pi / 2));
  const double lever = after.angle > 0 ? across / after.angle : crack_edge_;
  after.stretch = std::sqrt(before.stretch * before.stretch + 2 * lever * after.both + across * across);
  after.both += across * after.angle;
  return after;
}

std::vector<ExpectedError::Advance> ExpectedError::predicted_advances(
    const CrackState& crack, const std::vector<FrontOpening>& predicted) const {
  std::vector<Advance> advances;
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const Deviation before = deviation(crack.points[i]);
    const double error = scale_ * statement_.along_front * stated_angle_error(predicted[i], crack_edge_, m_);
    advances.push_back({before, after_error(before, error)});
  }
  return advances;
}

double ExpectedError::at_the_end(const CrackState& crack, const std::vector<FrontOpening>& predicted,
                                 double left) const {
  if (crack.points.empty()) return of_surface();
  const auto n = static_cast<double>(crack.points.size());
  double front = 0, made = sum_;
  for (const Advance& a : predicted_advances(crack, predicted)) {
    front += a.after.distance() / n;
    made += a.of_strip();
  }
  return ((1 - left) * made / (points_ + n) + left * front) / diagonal_;
}

void ExpectedError::advance(const CrackState& crack, const std::vector<Advance>& advances) {
  for (std::size_t i = 0; i < advances.size(); ++i) {
    at_[crack.points[i].node] = advances[i];
    sum_ += advances[i].of_strip();
    points_ += 1;
  }
}

void ExpectedError::advance_predicted(const CrackState& crack, const std::vector<FrontOpening>& predicted) {
  advance(crack, predicted_advances(crack, predicted));
}

void ExpectedError::advance_solved(const CrackState& crack, const std::vector<FrontOpening>& solved,
                                   const std::vector<FrontOpening>& predicted) {
  if (!predicted.empty()) compare(solved, predicted);
  std::vector<Advance> advances;
  for (const FrontPoint& point : crack.points) {
    const Deviation before = deviation(point);
    advances.push_back({before, {0, 0, 0, before.distance()}});
  }
  advance(crack, advances);
}

void ExpectedError::compare(const std::vector<FrontOpening>& solved,
                            const std::vector<FrontOpening>& predicted) {
  double seen = 0, stated = 0;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (!predicted[i].known || solved[i].intensity.isZero(0)) continue;
    const double error =
        turn_of(solved[i].intensity, crack_edge_, m_) - turn_of(predicted[i].intensity, crack_edge_, m_);
    const double s = stated_angle_error(predicted[i], crack_edge_, m_);
    seen += error * error;
    stated += s * s;
  }
  if (!(stated > 0)) return;
  const double now = seen / stated, before = compared_ ? scale_ * scale_ : now;
  scale_ = std::sqrt((1 - kForgetting) * before + kForgetting * now);
  compared_ = true;
}

}  // namespace conchoid
