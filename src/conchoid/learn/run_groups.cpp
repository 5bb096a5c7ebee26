#include "conchoid/learn/run_groups.hpp"

#include <algorithm>
#include <set>

namespace conchoid {
namespace {

constexpr std::size_t kDealtTogether = 12;

}  // namespace

std::vector<int> run_groups(const std::vector<std::int32_t>& run, int groups) {
  const std::set<std::int32_t> distinct(run.begin(), run.end());
  const std::vector<std::int32_t> ids(distinct.begin(), distinct.end());
  const auto count = static_cast<std::size_t>(groups);
  std::vector<int> group(run.size(), 0);
  if (ids.size() < count) return group;
  const std::size_t together = std::min(kDealtTogether, ids.size() / count);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto place =
        static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), run[i]) - ids.begin());
    group[i] = static_cast<int>(place / together % count);
  }
  return group;
}

}  // namespace conchoid
