#include "conchoid/sim/path_turn.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "conchoid/crack/front/front_frames.hpp"

namespace conchoid {

namespace {

/// Where a node of the front in some frame was about to go.
struct Way {
  NodeId node;
  FrontFrame frame;
  double angle;
  int seen;  ///< frame of the sheet
};

bool begins(const PathSoFar& path, NodeId node) {
  return node.index() >= path.given_nodes && path.sheet.travelled[node] == 0;
}

std::optional<Way> way_before(const PathSoFar& path, const Way& now) {
  const NodeId behind = path.sheet.correlation[now.node];
  const FrontHistory::Entry* before = behind.valid() ? path.history.find(behind) : nullptr;
  if (!before || before->seen + 1 != now.seen) return {};
  return Way{behind, before->frame, path.law.direction(before->driving), before->seen};
}

/// Angle from the way before to this one; of one that begins from its crack's plane.
std::optional<double> turned(const PathSoFar& path, const Way& now, const std::optional<Way>& before) {
  if (!before) return begins(path, now.node) ? std::optional(now.angle) : std::nullopt;
  const Vec3 was = direction_at(before->frame.e1, before->frame.e2, before->angle);
  return now.angle - std::atan2(was.dot(now.frame.e1), was.dot(now.frame.e2));
}

double least_of_one_sign(double a, double b) {
  return a * b > 0 ? std::copysign(std::min(std::abs(a), std::abs(b)), a) : 0;
}

}  // namespace

double further_turn(const PathSoFar& path, const FrontPoint& point, const FrontDecision& decision) {
  if (!point.correlation.valid()) return 0;
  const Way now{point.node, point.frame, decision.angle, path.sheet.frame};
  const std::optional<Way> before = way_before(path, now);
  const std::optional<double> last = turned(path, now, before);
  if (!last) return 0;
  double turn = least_of_one_sign(*last, 2 * now.angle);
  if (before) turn = least_of_one_sign(turn, turned(path, *before, way_before(path, *before)).value_or(0));
  const auto& x = path.sheet.mesh.positions;
  const double length = (x[point.node] - x[point.correlation]).norm();
  return turn * (decision.length < length ? decision.length / length : 1);
}

}  // namespace conchoid
