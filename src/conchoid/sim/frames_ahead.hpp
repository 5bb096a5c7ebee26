#pragma once

#include <vector>

#include "conchoid/sim/crack_state.hpp"

namespace conchoid {

/// Per front point how often its crack will advance, if it goes on in its mean plane until the body's section with that
/// plane is through: what is left of the section over the front points times r̄². 1 … kMostFramesAhead; the latter in an
/// infinite body, and for points on no crack inside of the body.
/// @param surface     of the body; empty: infinite
/// @param crack_edge  r̄ [m]
std::vector<int> frames_ahead(const CrackState& crack, const TriMesh& surface, double crack_edge);

inline constexpr int kMostFramesAhead = 25;

}  // namespace conchoid
