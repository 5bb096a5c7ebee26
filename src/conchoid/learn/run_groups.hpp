#pragma once

#include <cstdint>
#include <vector>

namespace conchoid {

/// Groups of whole runs, to be left out in turn: runs are dealt a dozen at a time, as neighbours in a database may be of
/// one body. @param run  per row  @return per row the group of its run, 0 … groups − 1; 0 for all where there are fewer
/// runs than groups
std::vector<int> run_groups(const std::vector<std::int32_t>& run, int groups);

/// Members of an ensemble, each fitted to all groups but one.
inline constexpr int kMembers = 4;

}  // namespace conchoid
