#include "conchoid/crack/fine/front_steps.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/front/front_frames.hpp"

namespace conchoid {

std::vector<FrontStep> with_drawn_nodes(const CrackSheet& sheet, const std::vector<FrontStep>& steps) {
  std::unordered_map<NodeId, FrontStep> given;
  for (const FrontStep& step : steps)
    given.emplace(step.node, step);
  const auto normals = node_area_vectors(sheet.mesh);
  std::vector<FrontStep> all = steps;
  for (const SheetFront& front : sheet.fronts) {
    const std::size_t n = front.nodes.size();
    const auto frames = front_frames(sheet.mesh, normals, front.nodes, front.closed);
    for (std::size_t i = 0; i < n; ++i) {
      if (sheet.state[front.nodes[i]] != FrontState::outside || given.contains(front.nodes[i])) continue;
      FrontStep drawn{front.nodes[i], frames[i], 0, 0};
      int count = 0;
      for (std::size_t k : {previous_index(i, n, front.closed), next_index(i, n, front.closed)}) {
        const auto at = given.find(front.nodes[k]);
        if (k == i || at == given.end() || !(at->second.intensity > 0)) continue;
        drawn.angle += at->second.angle;
        drawn.turn += at->second.turn;
        drawn.intensity += at->second.intensity;
        ++count;
      }
      if (count == 0) continue;
      drawn.angle /= count;
      drawn.turn /= count;
      drawn.intensity /= count;
      all.push_back(drawn);
    }
  }
  return all;
}

FrontSteps::FrontSteps(const CrackSheet& sheet, const SheetFront& front,
                       const IdVector<NodeId, Vec3>& normals,
                       const std::unordered_map<NodeId, FrontStep>& given)
    : nodes_(front.nodes), closed_(front.closed) {
  const auto frames = front_frames(sheet.mesh, normals, nodes_, closed_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto at = given.find(nodes_[i]);
    const bool stays = at == given.end() || sheet.state[nodes_[i]] == FrontState::arrested;
    steps_.push_back(stays ? FrontStep{nodes_[i], frames[i], 0, 0} : at->second);
  }
}

void FrontSteps::smooth_angles() {
  const std::size_t n = nodes_.size();
  if (n < 5) return;
  const std::vector<FrontStep> old = steps_;
  const auto moving = [&](std::size_t k) { return old[k].intensity > 0; };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = previous_index(i, n, closed_), b = next_index(i, n, closed_);
    const std::size_t aa = previous_index(a, n, closed_), bb = next_index(b, n, closed_);
    if (a == i || b == i || aa == a || bb == b) continue;
    if (!moving(aa) || !moving(a) || !moving(i) || !moving(b) || !moving(bb)) continue;
    for (double FrontStep::*of : {&FrontStep::angle, &FrontStep::turn}) {
      const double near = old[a].*of + old[b].*of, far = old[aa].*of + old[bb].*of;
      steps_[i].*of = (10 * old[i].*of + 4 * near - far) / 16;
    }
  }
}

FrontSteps::Place FrontSteps::place(double parameter) const {
  const std::size_t edges = edge_count(nodes_.size(), closed_);
  const double whole = std::max(0.0, std::floor(parameter));
  auto k = static_cast<std::size_t>(whole);
  if (closed_) k %= edges;
  if (k >= edges) return {edges - 1, edges, 1.0};
  return {k, next_index(k, nodes_.size(), closed_), parameter - whole};
}

FrontFrame FrontSteps::frame(double parameter) const {
  const auto [a, b, s] = place(parameter);
  return interpolate(steps_[a].frame, steps_[b].frame, s);
}

double FrontSteps::angle(double parameter, double time) const {
  const auto [a, b, s] = place(parameter);
  const auto of = [&](std::size_t k) { return steps_[k].angle + time * steps_[k].turn; };
  if (!moves(a)) return of(b);
  if (!moves(b)) return of(a);
  return (1 - s) * of(a) + s * of(b);
}

double FrontSteps::intensity(double parameter) const {
  const auto [a, b, s] = place(parameter);
  if (!moves(a)) return steps_[b].intensity;
  if (!moves(b)) return steps_[a].intensity;
  return (1 - s) * steps_[a].intensity + s * steps_[b].intensity;
}

double FrontSteps::length(double parameter, const GrowthLaw& law, double toughness, double resolution) const {
  const auto [a, b, s] = place(parameter);
  const auto of = [&](const FrontStep& step) {
    return std::min(step.limit, law.length(step.intensity, toughness, resolution));
  };
  return (1 - s) * of(steps_[a]) + s * of(steps_[b]);
}

}  // namespace conchoid
