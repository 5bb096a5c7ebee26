#include "conchoid/sim/path_correction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/surface/separation.hpp"

namespace conchoid {
namespace {

constexpr double kCorrectedTurn = 0.05;  // rad: less is noise of K, and leaves the path within r̄/40 of it
constexpr double kShare = 0.5;           // of the further turn

// Old front node of each new one that it moved to.
std::unordered_map<NodeId, NodeId> moved_from(const AdvanceResult& result) {
  std::unordered_map<NodeId, NodeId> from;
  for (const auto& front : result.succession)
    for (const FrontSuccession& s : front)
      if (s.kind == FrontSuccession::Kind::moved) from.emplace(s.node, s.first);
  return from;
}

// Further turn of each old node at the end of the frame on trial.
std::unordered_map<NodeId, double> turns_ahead(const CrackState& trial, const AdvanceResult& result,
                                               const std::vector<FrontOpening>& openings,
                                               const GrowthModel& growth) {
  const auto from = moved_from(result);
  std::unordered_map<NodeId, double> turns;
  for (std::size_t i = 0; i < trial.points.size(); ++i) {
    const NodeId node = trial.points[i].node;
    const auto old = from.find(node);
    if (old == from.end()) continue;
    const Vec3& K = openings[i].intensity;
    if (growth.law->drive(K) < growth.toughness(trial.sheet.mesh.positions[node]).value) continue;
    turns.emplace(old->second, growth.law->direction(K));
  }
  return turns;
}

}  // namespace

void correct_directions(std::vector<FrontStep>& steps, const CrackState& crack, const FineFront& fine,
                        const GrowthModel& growth, const PreparedBody& body, BemOpening& bem) {
  if (!body.toughness.homogeneous()) return;
  const auto turns = [](const FrontStep& step) { return std::abs(step.angle) > kCorrectedTurn; };
  if (std::none_of(steps.begin(), steps.end(), turns)) return;
  CrackState trial = crack;
  FineFront markers = fine;
  const AdvanceResult result =
      advance_fronts(trial.sheet, markers, with_drawn_nodes(trial.sheet, steps), growth, body.crack_edge);
  std::unordered_map<NodeId, double> further;
  try {
    update_crack(trial, body.surface, body.crack_edge);
    if (!body.infinite() && separates(trial.cut)) return;
    further = turns_ahead(trial, result, bem.open(trial), growth);
  } catch (const SingularSystem&) {
    return;
  }
  constexpr double most = 0.5 * std::numbers::pi;
  for (FrontStep& step : steps)
    if (const auto at = further.find(step.node); at != further.end() && turns(step))
      step.angle = std::clamp(step.angle + kShare * at->second, -most, most);
}

}  // namespace conchoid
