#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/invariants.hpp"
#include "crack_samples.hpp"

namespace conchoid::testing {

constexpr double kEdge = 0.2, kSpacing = 0.02, kToughness = 1e6;
const FineFrontSettings kSettings{.resolution = kEdge, .spacing = kSpacing};

inline Toughness homogeneous(const Vec3&) {
  return {kToughness, Vec3::Zero()};
}

/// K_eff that moves a node by the given share of r̄ per frame.
inline double intensity_for(double share) {
  return kToughness / std::sqrt(1 - share);
}

inline CrackSheet sheet_of(const std::vector<TriMesh>& parts) {
  CrackSheet sheet;
  for (const TriMesh& part : parts)
    append_part(sheet, part);
  return sheet;
}

/// A step for each active node of all fronts. @param angle(node), intensity(node)
template <class Angle, class Intensity>
std::vector<FrontStep> steps_of(const CrackSheet& sheet, Angle angle, Intensity intensity) {
  std::vector<FrontStep> steps;
  for (const SheetFront& front : sheet.fronts) {
    const auto frames = front_frames(sheet, front);
    for (std::size_t i = 0; i < front.nodes.size(); ++i)
      if (sheet.state[front.nodes[i]] == FrontState::active)
        steps.push_back({front.nodes[i], frames[i], angle(front.nodes[i]), intensity(front.nodes[i])});
  }
  return steps;
}

/// Cracks that grow, with a follower front or without; validated after every frame.
struct Growth {
  CrackSheet sheet;
  FineFront fine;
  std::optional<FineFront> follower;

  explicit Growth(const std::vector<TriMesh>& parts, std::optional<double> follower_spacing = std::nullopt,
                  const FineFrontSettings& settings = kSettings)
      : sheet(sheet_of(parts)), fine(sheet, settings) {
    if (follower_spacing)
      follower.emplace(sheet,
                       FineFrontSettings{.resolution = settings.resolution, .spacing = *follower_spacing});
  }
  explicit Growth(const TriMesh& mesh, const FineFrontSettings& settings = kSettings)
      : Growth(std::vector{mesh}, std::nullopt, settings) {}

  AdvanceResult advance(const std::vector<FrontStep>& steps, const ToughnessField& toughness = homogeneous) {
    AdvanceResult result = advance_fronts(sheet, fine, steps, {kLaw, toughness}, fine.settings().resolution,
                                          follower ? &*follower : nullptr);
    validate(sheet, fine);
    if (follower) validate(sheet, *follower);
    return result;
  }
  /// @param angle(node), share(node)  of r̄ that each moves
  template <class Angle, class Share>
  void frame(Angle angle, Share share) {
    advance(steps_of(sheet, angle, [&](NodeId n) { return intensity_for(share(n)); }));
  }
  void straight_frame(double share) {
    frame([](NodeId) { return 0.0; }, [=](NodeId) { return share; });
  }
};

}  // namespace conchoid::testing
