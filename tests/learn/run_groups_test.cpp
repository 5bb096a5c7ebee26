#include "conchoid/learn/run_groups.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace conchoid {
namespace {

TEST(RunGroups, RunsStayWholeAndGroupsAreAlike) {
  std::vector<std::int32_t> run;
  for (int r = 0; r < 480; ++r)
    for (int k = 0; k < 1 + r % 5; ++k)
      run.push_back(7 * r);
  const RunGroups groups = run_groups(run, 4);
  const std::vector<int>& group = groups.of_row;
  EXPECT_EQ(groups.count, 4);
  std::map<std::int32_t, std::set<int>> of_run;
  std::map<int, std::set<std::int32_t>> runs;
  for (std::size_t i = 0; i < run.size(); ++i) {
    of_run[run[i]].insert(group[i]);
    runs[group[i]].insert(run[i]);
  }
  for (const auto& [id, groups] : of_run)
    EXPECT_EQ(groups.size(), 1U) << id;
  ASSERT_EQ(runs.size(), 4U);
  for (const auto& [g, ids] : runs)
    EXPECT_EQ(ids.size(), 120U) << g;
  EXPECT_EQ(group[0], group[3]) << "the first dozen runs are dealt together";
}

TEST(RunGroups, AFewRunsAreDealtOneByOneAndFewerThanGroupsNotAtAll) {
  EXPECT_EQ(run_groups({5, 5, 6, 8, 9}, 4).of_row, (std::vector<int>{0, 0, 1, 2, 3}));
  EXPECT_EQ(run_groups({5, 5, 6, 8}, 4).of_row, (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(run_groups({5, 5, 6, 8}, 4).count, 1);
}

}  // namespace
}  // namespace conchoid
