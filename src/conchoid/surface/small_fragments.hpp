#pragma once

#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

struct FragmentLimits {
  double minimum_volume = 0;      ///< [m³]
  std::size_t maximum_count = 0;  ///< 0: no limit
};

/// The pieces with the small ones joined to others: the smallest piece goes to the neighbour with which it
/// shares the largest fracture area, again and again, until none is below the minimum volume and there are
/// not more than allowed. A piece without neighbours stays. Ties go to the piece that comes first. Needs
/// Fragment::volume; it is added up, nothing else of the masses is kept.
std::vector<Fragment> joined_small_fragments(std::vector<Fragment> fragments, const FragmentLimits& limits);

}  // namespace conchoid
