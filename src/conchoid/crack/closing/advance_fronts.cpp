#include "conchoid/crack/closing/advance_fronts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "conchoid/crack/closing/front_joint.hpp"
#include "conchoid/crack/closing/touching.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/invariants.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// What the nodes are about to do, before the markers say it exactly.
std::vector<FrontMotion> expected_motions(const CrackSheet& sheet, const std::vector<FrontStep>& steps,
                                          const GrowthModel& model, double target_edge) {
  std::vector<bool> on_front(sheet.mesh.node_count(), false);
  for (const SheetFront& front : sheet.fronts)
    for (const NodeId node : front.nodes)
      on_front[node.index()] = true;
  std::vector<FrontMotion> expected;
  for (const FrontStep& step : steps) {
    if (!on_front[step.node.index()] || sheet.state[step.node] == FrontState::arrested) continue;
    const double length = model.law->length(
        step.intensity, model.toughness(sheet.mesh.positions[step.node]).value, target_edge);
    if (length > 0)
      expected.push_back(
          {step.node, length * direction_at(step.frame.e1, step.frame.e2, step.angle + 0.5 * step.turn)});
  }
  return expected;
}

/// How far nodes may move [m].
using StepLimits = std::unordered_map<NodeId, double>;

void limit(StepLimits& limits, NodeId node, double length) {
  double& least = limits.try_emplace(node, length).first->second;
  least = std::min(least, length);
}

/// Nodes that touch and have not been joined stop for good, unless the ligament is wide and will be narrow
/// enough in the next frame; then both sides go on by a part of it. Outside of the body they go on as far as they do not
/// pass each other.
void stop_at_fronts(CrackSheet& sheet, const std::vector<FrontMotion>& expected, double target_edge,
                    StepLimits& limits) {
  std::unordered_map<NodeId, double> way;
  for (const FrontMotion& motion : expected)
    way.emplace(motion.node, motion.displacement.norm());
  const auto normals = unit_node_normals(sheet.mesh);
  for (const FrontTouch& touch : front_touches(sheet, expected, target_edge)) {
    const SheetFront& other = sheet.fronts[touch.other];
    const NodeId node = sheet.fronts[touch.front].nodes[touch.index];
    if (sheet.state[node] == FrontState::outside) {
      limit(limits, node, kShareOfGap * touch.gap);
      continue;
    }
    const std::array<NodeId, 2> ends{other.nodes[touch.edge],
                                     other.nodes[next_index(touch.edge, other.nodes.size(), other.closed)]};
    double opposite = 0;
    bool alike = true;
    for (const NodeId n : ends) {
      if (const auto at = way.find(n); at != way.end()) opposite = std::max(opposite, at->second);
      alike = alike && normals[n].dot(normals[node]) > kAlikeSheets;
    }
    const bool wide = alike && touch.gap > kWidestLigament * target_edge;
    const double share = (touch.gap - kNarrowedLigament * target_edge) / (way.at(node) + opposite);
    for (const NodeId n : {node, ends[0], ends[1]}) {
      if (sheet.state[n] != FrontState::active) continue;
      if (!wide) sheet.state[n] = FrontState::arrested;
      if (const auto at = way.find(n); wide && at != way.end()) limit(limits, n, share * at->second);
    }
  }
}

/// Where the front opens like a wedge its sides come together first: the node at its bottom waits, and the
/// next ones leave room for the other side.
void wait_in_corners(const CrackSheet& sheet, const std::vector<FrontMotion>& expected, StepLimits& limits) {
  std::unordered_set<NodeId> moving;
  for (const FrontMotion& motion : expected)
    if (sheet.state[motion.node] == FrontState::active) moving.insert(motion.node);
  const auto& x = sheet.mesh.positions;
  const auto area_vectors = node_area_vectors(sheet.mesh);
  for (const SheetFront& front : sheet.fronts) {
    const std::size_t n = front.nodes.size();
    const std::vector<FrontFrame> frames = front_frames(sheet, front, area_vectors);
    for (std::size_t i = 0; i < n; ++i) {
      const NodeId node = front.nodes[i];
      const std::size_t before = previous_index(i, n, front.closed), after = next_index(i, n, front.closed);
      if (moving.contains(front.nodes[before]) && moving.contains(front.nodes[after]) &&
          opening_angle(sheet, front, frames[i], i) < kWaitingWedge)
        limit(limits, node, 0);
      for (const auto& [a, b] : {std::pair{before, previous_index(before, n, front.closed)},
                                 std::pair{after, next_index(after, n, front.closed)}}) {
        if (a == i || b == a || b == i) continue;
        if ((frames[a].e2 + frames[b].e2).normalized().dot(frames[i].e2) > kFacingWays) continue;
        if ((0.5 * (x[front.nodes[a]] + x[front.nodes[b]]) - x[node]).dot(frames[i].e2) <= 0) continue;
        limit(limits, node,
              kShareOfGap * segment_distance(x[node], x[node], x[front.nodes[a]], x[front.nodes[b]]));
      }
    }
  }
}

}  // namespace

AdvanceResult advance_fronts(CrackSheet& sheet, FineFront& fine, const std::vector<FrontStep>& given,
                             const GrowthModel& model, double target_edge, FineFront* follower) {
  std::vector<FrontStep> steps = given;
  auto expected = expected_motions(sheet, steps, model, target_edge);
  for (std::size_t left = expected.size(); left > 0; --left) {
    const auto joint = find_joint(sheet, expected, target_edge);
    if (!joint) break;
    const JoinedFronts joined = join_fronts(sheet, *joint);
    fine.join(sheet, *joint, joined);
    if (follower) follower->join(sheet, *joint, joined);
    // The front turns there: frame and K are those of the front that was.
    std::erase_if(steps, [&](const FrontStep& step) {
      return step.node == joint->first.front() || step.node == joint->first.back() ||
             step.node == joint->second.front() || step.node == joint->second.back();
    });
    expected = expected_motions(sheet, steps, model, target_edge);
  }
  StepLimits limits;
  stop_at_fronts(sheet, expected, target_edge, limits);
  wait_in_corners(sheet, expected, limits);
  for (FrontStep& step : steps)
    if (const auto at = limits.find(step.node); at != limits.end())
      step.limit = std::min(step.limit, at->second);
  std::erase_if(steps, [&](const FrontStep& step) { return step.limit < kLeastStep * target_edge; });
  const auto motions = fine.advance(sheet, steps, model);
  if (follower) follower->advance(sheet, steps, model, fine);
  for (const NodeId node : fine.stopped_nodes())
    if (sheet.state[node] == FrontState::active) sheet.state[node] = FrontState::arrested;
  AdvanceSettings settings;
  settings.smoothing = 0;
  settings.stop_touching = false;  // seen to already, before the markers set out
  std::unordered_map<NodeId, Vec3> displacement;
  for (const FrontMotion& motion : motions)
    displacement.emplace(motion.node, motion.displacement);
  const auto successor = [&](NodeId n) {
    const auto at = displacement.find(n);
    return at == displacement.end() ? sheet.mesh.positions[n] : Vec3(sheet.mesh.positions[n] + at->second);
  };
  settings.between = [&](NodeId a, NodeId b, double s) {
    const auto marker = fine.between(a, b, s);
    return marker ? *marker : Vec3((1 - s) * successor(a) + s * successor(b));
  };
  AdvanceResult result = advance(sheet, motions, target_edge, settings);
  fine.adopt(sheet, result);
  if (follower) follower->adopt(sheet, result);
#ifndef NDEBUG
  validate(sheet, fine);
  if (follower) validate(sheet, *follower);
#endif
  return result;
}

}  // namespace conchoid
