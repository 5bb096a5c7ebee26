#include "conchoid/sim/ligament_rule.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {
namespace {

// × area of the cracks: what is left of a body, not a chip off one that a young crack could still cross.
constexpr double kLargestShareLeft = 0.2;

// Whether the crack would run on at the rim of the ligament, even if K were less by a factor.
bool is_driven(const LastLigament& ligament, const FrontReadings& front, double factor) {
  const std::vector<FrontPoint>& points = front.crack.points;
  if (front.carried || ligament.faces.empty() || points.empty()) return true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (front.openings[i].known && front.decisions[i].drive <= factor * front.decisions[i].toughness)
      continue;
    const Vec3& x = front.crack.sheet.mesh.positions[points[i].node];
    if (std::any_of(ligament.faces.begin(), ligament.faces.end(),
                    [&](const Vec3& y) { return (x - y).norm() < kWidestLigament * front.crack_edge; }))
      return true;
  }
  return false;
}

}  // namespace

bool opens_beyond_elasticity(const Vec3& K, double crack_edge, const ElasticConstants& m) {
  return opening_from_intensity(K, crack_edge, m).norm() > kLargestOpening * crack_edge;
}

bool is_unresolved(const FrontReadings& front) {
  for (const FrontOpening& opening : front.openings)
    if (!opening.known || opens_beyond_elasticity(opening.intensity, front.crack_edge, front.material))
      return true;
  return front.openings.empty();
}

bool is_barred(const CrackState& crack) {
  return std::any_of(crack.points.begin(), crack.points.end(), [&](const FrontPoint& point) {
    return crack.sheet.state[point.node] == FrontState::arrested;
  });
}

bool ligament_breaks_at_once(const LastLigament& ligament, const FrontReadings& front, bool at_end) {
  const double r = front.crack_edge;
  if (ligament.half_width <= 0.5 * kThinnestLigament * r) return true;  // nothing tells its K
  if (at_end || ligament.half_width <= 0.5 * kWidestLigament * r) return is_driven(ligament, front, 1);
  const double left = static_cast<double>(ligament.faces.size()) * std::pow(ligament.grid->size(), 2);
  return ligament.half_width <= 0.5 * kWidestOverloadedLigament * r &&
         left <= kLargestShareLeft * surface_area(front.crack.trimmed) &&
         is_driven(ligament, front, kOverloadedRim);
}

}  // namespace conchoid
