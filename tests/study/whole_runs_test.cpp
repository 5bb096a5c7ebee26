#include "conchoid/study/whole_runs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "conchoid/study/small_changes.hpp"
#include "conchoid/study/surface_distance.hpp"

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
  const WholeRuns result = whole_runs(
      cubes(), runs, {{"again", "bem", nullptr}, {"steady", "steady", nullptr}}, {.least_frames = 2});
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

// A hybrid run solves what it does not dare to predict: with a tolerance of nothing all of it.
TEST(WholeRuns, AHybridRunOfNoToleranceIsTheSolvedOne) {
  const std::array<std::int32_t, 1> runs = {1};
  const WholeRuns result = whole_runs(
      cubes(), runs,
      {{"kept", "kept", nullptr}, {"0", "hybrid", nullptr, 0.0}, {"0.02", "hybrid", nullptr, 0.02}},
      {.least_frames = 2});
  const auto score = scores(result);
  EXPECT_NEAR(score.at({"cube", "0"}).largest, 0, 1e-12);
  EXPECT_GT(score.at({"cube", "kept"}).median, score.at({"cube", "0.02"}).median);
  EXPECT_LT(score.at({"cube", "kept"}).opening_ratio, score.at({"cube", "0"}).opening_ratio);
}

// A tenth of a load that breaks the cube opens no crack.
TEST(WholeRuns, TheLoadOfASpecificationIsMultiplied) {
  const DatabaseSpec spec = cubes();
  const auto body = std::make_shared<const PreparedBody>(prepare(spec.scene));
  const PreparedRun run = prepare_run(spec, body, 0), more = with_load(run, 2.5);
  for (std::size_t c = 0; c < run.scene.boundary.size(); ++c)
    EXPECT_EQ(more.scene.boundary[c].value, Vec3(2.5 * run.scene.boundary[c].value));
  const std::array<std::int32_t, 1> runs = {0};
  const WholeRuns stronger =
                      whole_runs(spec, runs, {{"again", "bem", nullptr}}, {.least_frames = 2, .load = 2.5}),
                  weaker =
                      whole_runs(spec, runs, {{"again", "bem", nullptr}}, {.least_frames = 2, .load = 0.1});
  ASSERT_EQ(stronger.rows.size(), 1U);
  EXPECT_NEAR(stronger.rows[0].surface, 0, 1e-12);
  EXPECT_EQ(weaker.left_out, 1);
}

TEST(WholeRuns, RunsThatAreTooShortAreLeftOutAndCounted) {
  const std::array<std::int32_t, 2> runs = {0, 1};
  const WholeRuns result = whole_runs(cubes(), runs, {{"kept", "kept", nullptr}}, {.least_frames = 1000});
  EXPECT_TRUE(result.rows.empty());
  EXPECT_EQ(result.left_out, 2);
}

// Each change of a scene is a run of its own; what it moves is more than nothing, and less than a closed form's error. On
// other elements a crack may start elsewhere, or not at all.
TEST(WholeRuns, TheNoiseFloorIsWhatSmallChangesMove) {
  const std::array<std::int32_t, 2> runs = {0, 1};
  const WholeRuns result =
      whole_runs(cubes(), runs, {{"steady", "steady", nullptr}}, {.least_frames = 2, .noise_floor = true});
  const auto score = scores(result);
  const double closed_form = score.at({"", "steady"}).median;
  for (const SmallChange& change : small_changes()) {
    EXPECT_EQ(score.at({"", change.title}).runs, score.at({"", "steady"}).runs) << change.title;
    EXPECT_GT(score.at({"", change.title}).median, 0) << change.title;
    if (change.title.find("elements") == std::string::npos) {
      EXPECT_LT(score.at({"", change.title}).median, 0.5 * closed_form) << change.title;
    }
  }
}

// What is drawn is what was measured.
TEST(WholeRuns, TheFarthestOffAreMadeAgainToBeLookedAt) {
  const std::array<std::int32_t, 3> runs = {0, 1, 2};
  const RunMethod steady{"steady", "steady", nullptr};
  const WholeRuns result =
      whole_runs(cubes(), runs, {{"kept", "kept", nullptr}, steady}, {.least_frames = 2});
  const std::vector<WholeRun> rows = farthest_off(result, "steady", 2);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_GT(rows[0].surface, rows[1].surface);
  for (const WholeRun& row : result.rows)
    EXPECT_TRUE(row.title == "kept" || row.surface <= rows[0].surface);
  const std::vector<CrackSurfaces> made = crack_surfaces(cubes(), rows, steady);
  ASSERT_EQ(made.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(symmetric_distance(made[i].solved, made[i].made).mean / bounding_box(made[i].body).diagonal(),
              rows[i].surface);
  EXPECT_TRUE(farthest_off(result, "stress", 2).empty());
}

TEST(SmallChanges, ALoadIsTurnedByHalfADegreeAndStaysAsLarge) {
  const DatabaseSpec spec = cubes();
  const auto body = std::make_shared<const PreparedBody>(prepare(spec.scene));
  const PreparedRun run = prepare_run(spec, body, 0);
  const auto changed = [&](std::size_t i) { return small_changes().at(i).change(run); };
  const auto larger = changed(0), turned = changed(1), longer = changed(2);
  ASSERT_TRUE(larger && turned && longer);
  for (std::size_t c = 0; c < run.scene.boundary.size(); ++c) {
    const Vec3& t = run.scene.boundary[c].value;
    EXPECT_NEAR((larger->scene.boundary[c].value - 1.005 * t).norm(), 0, 1e-12 * t.norm());
    const Vec3& u = turned->scene.boundary[c].value;
    EXPECT_NEAR(u.norm(), t.norm(), 1e-12 * t.norm());
    EXPECT_NEAR(std::acos(u.dot(t) / t.squaredNorm()) * 180 / std::numbers::pi, 0.5, 1e-9);
  }
  EXPECT_DOUBLE_EQ(longer->body->crack_edge, 1.1 * body->crack_edge);
}

}  // namespace
}  // namespace conchoid
