#pragma once

#include <cstdint>
#include <vector>

namespace conchoid {

/// Groups of whole runs, to be left out in turn: runs are dealt a dozen at a time, as neighbours in a database may be of
/// one body.
struct RunGroups {
  std::vector<int> of_row;  ///< that of its run, 0 … count − 1
  int count = 1;            ///< 1 where there are fewer runs than groups
};
/// @param run  per row @param groups  wanted
RunGroups run_groups(const std::vector<std::int32_t>& run, int groups);

}  // namespace conchoid
