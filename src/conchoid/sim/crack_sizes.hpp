#pragma once

#include <vector>

#include "conchoid/sim/crack_state.hpp"

namespace conchoid {

/// What of a crack a point of its front feels.
struct CrackSize {
  double area = 0;  ///< [m²]; 0: the point is on no crack inside the body
  bool at_surface = false;
  int crack = -1;  ///< number of the connected crack
};

/// Per point of the crack state: the connected crack that it belongs to.
std::vector<CrackSize> crack_sizes(const CrackState& crack);

}  // namespace conchoid
