#pragma once

#include <vector>

#include "conchoid/crack/intensity/front_resolution.hpp"
#include "conchoid/sim/front_gaps.hpp"

namespace conchoid {

/// resolve_along_front() on every connected front inside the body, in the order of crack.points. Points on no
/// such front keep their K.
std::vector<FrontResolution> resolve_points(const CrackState& crack,
                                            const std::vector<FrontOpening>& openings,
                                            const ToughnessField& toughness, const ElasticConstants& m);

}  // namespace conchoid
