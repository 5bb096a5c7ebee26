#pragma once

#include <vector>

#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// Directions of a frame corrected at its middle (Heun's rule): the frame is made on a copy of the crack and
/// solved, and each point that turns by more than 0.05 rad turns by half of what its successor there would turn
/// further,
///     θ ← θ + ½ θ(K at the successor)                                          docs/theory.md (S11)
/// so that the path is of second order in r̄ and swings less about the one on which K_II vanishes. A crack that
/// goes straight on costs no second solution. Where the toughness varies nothing is corrected: there the markers
/// find their way themselves, and what is left at the end of a frame is their doing. Nor is it where the frame
/// on trial separates the body or cannot be solved.
/// @param bem  holds the solution of the frame on trial afterwards, if there was one
void correct_directions(std::vector<FrontStep>& steps, const CrackState& crack, const FineFront& fine,
                        const GrowthModel& growth, const PreparedBody& body, BemOpening& bem);

}  // namespace conchoid
