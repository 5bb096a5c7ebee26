#pragma once

#include "conchoid/crack/law/growth_law.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/front_history.hpp"

namespace conchoid {

/// What the cracks did until now.
struct PathSoFar {
  const FrontHistory& history;  ///< of the frames before this one
  const GrowthLaw& law;
  const CrackSheet& sheet;
  std::size_t given_nodes;  ///< first nodes of the sheet: of cracks that were given, not started in the run
};

/// By how much the path of a point turns while a step is made [rad], as K says only in which direction the step
/// begins: FrontStep::turn. As much as it has turned since the frame before (the second order of Adams & Bashforth),
/// per length of the step; or less, where it turned less in the frame before that or the other way: what alternates
/// is no curvature. And the last step has turned already, by what was foreseen then: where K now asks for less
/// than half of it the path is straighter than that, where it asks for the opposite it is straight. A crack that has
/// started lies across the tension at its centre, where its path begins; one that was given lies as it was given,
/// and where it begins to move nothing is foreseen.
/// @param decision  angle and length the law gives
double further_turn(const PathSoFar& path, const FrontPoint& point, const FrontDecision& decision);

}  // namespace conchoid
