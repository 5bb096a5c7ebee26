#include "conchoid/sim/expected_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/sim/front_gaps.hpp"
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

double deviation_of_mean(std::size_t n, double correlation) {
  const auto count = static_cast<double>(n);
  double sum = 1, power = 1;
  for (std::size_t k = 1; k < n; ++k) {
    power *= correlation;
    sum += 2 * (1 - static_cast<double>(k) / count) * power;
  }
  return std::sqrt(sum / count);
}

std::optional<ExpectedError::Deviation> ExpectedError::known(const FrontPoint& point) const {
  if (const auto still = at_.find(point.node); still != at_.end()) return still->second.before;
  if (const auto grown = at_.find(point.correlation); grown != at_.end()) return grown->second.after;
  return std::nullopt;
}

ExpectedError::Deviation ExpectedError::mean(const std::vector<Deviation>& all) {
  Deviation m;
  const auto n = static_cast<double>(all.size());
  for (const Deviation& d : all) {
    m.angle += d.angle / n;
    m.both += d.both / n;
    m.stretch += d.stretch / n;
    m.earlier += d.earlier / n;
  }
  return m;
}

ExpectedError::Deviation ExpectedError::last_on(const std::vector<int>& parts, int part) const {
  std::vector<Deviation> there;
  for (const NodeId node : front_)
    if (parts[node.index()] == part) there.push_back(at_.at(node).after);
  return mean(there);
}

std::vector<ExpectedError::Deviation> ExpectedError::deviations(const CrackState& crack) const {
  std::vector<std::optional<Deviation>> found;
  for (const FrontPoint& point : crack.points)
    found.push_back(known(point));
  std::vector<Deviation> out;
  for (const auto& d : found)
    out.push_back(d.value_or(Deviation{}));
  std::vector<int> parts;
  for (const PointChain& chain : point_chains(crack)) {
    std::vector<Deviation> of_chain;
    for (const std::size_t i : chain.points)
      if (found[i]) of_chain.push_back(*found[i]);
    if (of_chain.size() == chain.points.size()) continue;
    Deviation rest = mean(of_chain);
    if (of_chain.empty() && !front_.empty()) {
      if (parts.empty()) parts = connected_parts(crack.sheet.mesh);
      rest = last_on(parts, parts[crack.points[chain.points[0]].node.index()]);
    }
    for (const std::size_t i : chain.points)
      if (!found[i]) out[i] = rest;
  }
  return out;
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

std::vector<double> ExpectedError::errors(const CrackState& crack,
                                          const std::vector<FrontOpening>& predicted) const {
  std::vector<double> of_front(crack.points.size(), 1);  // b; of a point on no front its own error is all
  for (const PointChain& chain : point_chains(crack))
    for (const std::size_t i : chain.points)
      of_front[i] = deviation_of_mean(chain.points.size(), statement_.correlation);
  std::vector<double> errors;
  for (std::size_t i = 0; i < crack.points.size(); ++i)
    errors.push_back(scale_ * statement_.amount * of_front[i] *
                     stated_angle_error(predicted[i], crack_edge_, m_));
  return errors;
}

double ExpectedError::at_the_end(const CrackState& crack, const std::vector<FrontOpening>& predicted,
                                 const std::vector<int>& frames) const {
  const std::vector<double> error = errors(crack, predicted);
  const std::vector<Deviation> before = deviations(crack);
  double sum = sum_, strips = points_;
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    Deviation now = before[i];
    for (int frame = 0; frame < frames[i]; ++frame) {
      const Deviation after = after_error(now, error[i]);
      sum += Advance{now, after}.of_strip();
      strips += 1;
      now = after;
    }
  }
  return strips > 0 ? sum / strips / diagonal_ : 0;
}

void ExpectedError::advance(const CrackState& crack, const std::vector<Advance>& advances) {
  front_.clear();
  for (std::size_t i = 0; i < advances.size(); ++i) {
    front_.push_back(crack.points[i].node);
    at_[crack.points[i].node] = advances[i];
    sum_ += advances[i].of_strip();
    points_ += 1;
  }
}

void ExpectedError::advance_predicted(const CrackState& crack, const std::vector<FrontOpening>& predicted) {
  const std::vector<double> error = errors(crack, predicted);
  std::vector<Advance> advances;
  for (const Deviation& before : deviations(crack))
    advances.push_back({before, after_error(before, error[advances.size()])});
  advance(crack, advances);
}

void ExpectedError::advance_solved(const CrackState& crack, const std::vector<FrontOpening>& solved,
                                   const std::vector<FrontOpening>& predicted) {
  if (!predicted.empty()) compare(solved, predicted);
  std::vector<Advance> advances;
  for (const Deviation& before : deviations(crack))
    advances.push_back({before, {0, 0, 0, before.distance()}});
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
