#pragma once

#include <vector>

#include "conchoid/sim/front_gaps.hpp"
#include "conchoid/sim/front_history.hpp"

namespace conchoid {

/// Which nodes, that were on a front in the frame before, a point of the front is taken to come from.
struct FrontPast {
  /// Its correlation node. Else, as it was not on a front inside the body: those of the nearest points along its connected front that
  /// come from one, one to each side; else the node nearest in space that was on a front last. Empty where nothing was.
  std::vector<NodeId> nodes;
  bool correlation = false;  ///< it is that of its correlation node
  bool own = false;          ///< and no other point is nearer to that: it was not put between others
};

/// One for each point of the crack.
std::vector<FrontPast> front_pasts(const CrackState& crack, const FrontHistory& history);

}  // namespace conchoid
