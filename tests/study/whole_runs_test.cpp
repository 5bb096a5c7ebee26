#include "conchoid/study/whole_runs.hpp"

#include <gtest/gtest.h>

#include <array>

namespace conchoid {
namespace {

DatabaseSpec cubes() {
  return parse_database_spec(
      "[body]\nmodel = 'cube'\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
      "[resolution]\ncrack = 0.14\nsurface = 0.014\n"
      "[database]\nruns = 4\nseed = 5\nregions = ['z+', 'z-']\nmagnitude = [8e7, 1.2e8]\nslope = [20, 50]\n",
      "cubes.toml", ".");
}

TEST(WholeRuns, BoundaryElementsAgreeWithThemselvesAndClosedFormsDoNot) {
  const std::array<std::int32_t, 3> runs = {0, 1, 2};
  const WholeRuns result =
      whole_runs(cubes(), runs, {{"again", "bem", nullptr}, {"steady", "steady", nullptr}}, 2);
  ASSERT_FALSE(result.rows.empty());
  EXPECT_EQ(result.rows.size() / 2 + static_cast<std::size_t>(result.left_out), runs.size());
  for (const WholeRun& row : result.rows) {
    EXPECT_EQ(row.body_class, "cube");
    if (row.title == "again") {
      EXPECT_NEAR(row.surface, 0, 1e-12);
      EXPECT_EQ(row.frames, row.solved_frames);
      EXPECT_EQ(row.stop, row.solved_stop);
    } else {
      EXPECT_GT(row.surface, 0);
      EXPECT_GE(row.of_crack, row.surface);
      EXPECT_LE(row.frames, 2 * row.solved_frames + 4);
    }
  }
  const auto score = scores(result).at({"cube", "again"});
  EXPECT_EQ(score.runs, static_cast<int>(result.rows.size() / 2));
  EXPECT_NEAR(score.largest, 0, 1e-12);
  EXPECT_EQ(score.frames_ratio, 1);
  EXPECT_EQ(scores(result).at({"", "again"}).runs, score.runs);
}

TEST(WholeRuns, RunsThatAreTooShortAreLeftOutAndCounted) {
  const std::array<std::int32_t, 2> runs = {0, 1};
  const WholeRuns result = whole_runs(cubes(), runs, {{"kept", "kept", nullptr}}, 1000);
  EXPECT_TRUE(result.rows.empty());
  EXPECT_EQ(result.left_out, 2);
}

}  // namespace
}  // namespace conchoid
