#include "conchoid/learn/run_groups.hpp"

#include <algorithm>
#include <set>

namespace conchoid {
namespace {

constexpr std::size_t kDealtTogether = 12;

}  // namespace

RunGroups run_groups(const std::vector<std::int32_t>& run, int groups) {
  const std::set<std::int32_t> distinct(run.begin(), run.end());
  const std::vector<std::int32_t> ids(distinct.begin(), distinct.end());
  const auto count = static_cast<std::size_t>(groups);
  RunGroups out{std::vector<int>(run.size(), 0)};
  if (ids.size() < count) return out;
  out.count = groups;
  const std::size_t together = std::min(kDealtTogether, ids.size() / count);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto place =
        static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), run[i]) - ids.begin());
    out.of_row[i] = static_cast<int>(place / together % count);
  }
  return out;
}

}  // namespace conchoid
