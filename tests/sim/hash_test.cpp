#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

// Same scene, same bits.
namespace conchoid {
namespace {

Scene cube() {
  return test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {3e7, 1e7, 9e7}) +
      test::boundary_text("z-", "traction", {-3e7, -1e7, -9e7}) + "[run]\ninertia_relief = true\n");
}

RunResult run(RunOptions options) {
  options.progress = false;
  return run_scene(cube(), options);
}

TEST(Hash, SameForOneThreadAndForTwo) {
  const RunResult one = ExecutionContext(1).run([] { return run({}); });
  const RunResult two = ExecutionContext(2).run([] { return run({}); });
  EXPECT_EQ(one.document.stop, StopReason::separated);
  EXPECT_EQ(one.document.hash, two.document.hash);
  EXPECT_EQ(one.document.frames, two.document.frames);
}

TEST(Hash, SameWithAFolderWrittenAndWithout) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  const RunResult written = run(options);
  EXPECT_EQ(run({}).document.hash, written.document.hash);
  const RunData read = read_run(*options.folder);
  EXPECT_EQ(read.document.hash, written.document.hash);
  EXPECT_EQ(read.crack.positions.size(), written.crack.positions.size());
  EXPECT_EQ(read.fragments.size(), written.fragments.size());
}

TEST(Hash, AnotherLoadGivesAnother) {
  Scene other = cube();
  other.boundary[0].value *= 1.001;
  other.boundary[1].value *= 1.001;
  RunOptions options;
  options.progress = false;
  EXPECT_NE(run_scene(other, options).document.hash, run({}).document.hash);
}

TEST(Methods, SteadyPredictionEndsAndIsRepeatable) {
  RunOptions options;
  options.method = "steady";
  const RunResult result = run(options);
  EXPECT_EQ(result.document.method, "steady");
  EXPECT_TRUE(result.document.stop == StopReason::separated || result.document.stop == StopReason::arrested ||
              result.document.stop == StopReason::frame_limit)
      << result.document.stop;
  ASSERT_GE(result.document.timings.size(), 2u);
  EXPECT_EQ(result.document.timings[0].source, "bem");
  EXPECT_EQ(result.document.timings[1].source, "steady");
  EXPECT_GT(result.largest_growth, 0.2);
  EXPECT_EQ(run(options).document.hash, result.document.hash);
}

// One run is far too little to learn from: what counts here is that the run starts as the BEM run does, ends
// by itself and is repeatable.
TEST(Methods, ForestPredictsFromTheSecondFrameOn) {
  const RunResult bem = run({});
  ASSERT_GT(bem.samples.size(), 20u);
  const RegressionForest forest = RegressionForest::train(
      bem.samples, {.trees = 20, .depth = 8, .features = FeatureSet::dimensionless, .seed = 1, .bins = 64},
      {});
  RunOptions options;
  options.method = "forest";
  options.regressor = &forest;
  const RunResult result = run(options);
  ASSERT_GE(result.document.timings.size(), 2u);
  EXPECT_EQ(result.document.timings[0].source, "bem");
  EXPECT_EQ(result.document.timings[1].source, "forest");
  ASSERT_EQ(result.front[0].frame, 1);
  EXPECT_EQ(result.front[0].intensity, bem.front[0].intensity);
  EXPECT_TRUE(result.document.stop == StopReason::separated || result.document.stop == StopReason::arrested)
      << result.document.stop;
  EXPECT_GT(result.largest_growth, 0.2);
  EXPECT_EQ(run(options).document.hash, result.document.hash);
}

TEST(Methods, ForestIsAskedFor) {
  RunOptions options;
  options.method = "forest";
  EXPECT_THROW(run(options), InputError);
}

}  // namespace
}  // namespace conchoid
