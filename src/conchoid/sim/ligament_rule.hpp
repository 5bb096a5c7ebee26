#pragma once

#include <vector>

#include "conchoid/crack/closing/last_ligament.hpp"
#include "conchoid/sim/fracture.hpp"

namespace conchoid {

/// What a frame has found at the front points, one entry per point of the crack each.
struct FrontReadings {
  const CrackState& crack;
  const std::vector<FrontOpening>& openings;
  const std::vector<FrontDecision>& decisions;
  const ElasticConstants& material;
  double crack_edge;  ///< r̄ [m]
  bool carried;       ///< the frame could not be solved
};

/// Whether K stands for an opening beyond kLargestOpening (learn/sample.hpp): what holds there is a ligament.
/// @param crack_edge  r̄ [m]
bool opens_beyond_elasticity(const Vec3& K, double crack_edge, const ElasticConstants& m);

/// Whether the elements cannot resolve the opening somewhere, or there is no front.
bool is_unresolved(const FrontReadings& front);

/// Whether another crack bars a front's way.
bool is_barred(const CrackState& crack);

/// Whether a ligament is driven beyond what it bears, and too narrow for the elements; at_end, where no front can go on,
/// whatever its width. A wide one breaks only where little is left beside what is cracked.
bool ligament_breaks_at_once(const LastLigament& ligament, const FrontReadings& front, bool at_end);

}  // namespace conchoid
