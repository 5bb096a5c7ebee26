#pragma once

#include "conchoid/crack/fine/fine_front.hpp"

namespace conchoid {

/// One frame of the coarse and the fine front together. Where two stretches of fronts are about to touch, the
/// ligament between them breaks first (find_joint); if it is still too wide for that the fronts go on by half
/// of it at most, and where the sheets are not oriented alike both stop there for good.
/// @param follower  another fine front of the same sheet, which follows `fine`; may be null
AdvanceResult advance_fronts(CrackSheet& sheet, FineFront& fine, const std::vector<FrontStep>& steps,
                             const GrowthModel& model, double target_edge, FineFront* follower = nullptr);

}  // namespace conchoid
