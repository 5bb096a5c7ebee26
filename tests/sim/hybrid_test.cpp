#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "conchoid/learn/forest.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/predicted_opening.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/study/surface_distance.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

// Frames predicted as long as the surface stays within a tolerance, and solved elsewhere.
namespace conchoid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RunResult run(const std::string& text, const std::string& method, std::optional<double> tolerance = {},
              const Regressor* regressor = nullptr, std::optional<int> frames = {}) {
  RunOptions options;
  options.method = method;
  options.tolerance = tolerance;
  options.regressor = regressor;
  options.frames = frames;
  options.progress = false;
  return run_scene(test::scene_from_text(text), options);
}

const RunResult& solved_cube() {
  static const RunResult result = run(test::pulled_cube_text(), "bem");
  return result;
}

const RegressionForest& forest() {
  static const RegressionForest trained = RegressionForest::train(
      solved_cube().samples,
      {.trees = 20, .depth = 8, .features = FeatureSet::dimensionless, .seed = 1, .bins = 64});
  return trained;
}

double distance_from_solved(const RunResult& result) {
  return symmetric_distance(solved_cube().crack, result.crack).mean;
}

TEST(Hybrid, ToleranceZeroIsTheSolution) {
  const std::string text = test::pulled_cube_text();
  for (const Regressor* regressor :
       {static_cast<const Regressor*>(nullptr), static_cast<const Regressor*>(&forest())}) {
    const RunResult result = run(text, "hybrid", 0, regressor);
    EXPECT_EQ(result.document.hash, solved_cube().document.hash);
    EXPECT_EQ(result.document.solved_frames, result.document.frames);
    EXPECT_EQ(result.document.expected_error, 0.0);
  }
}

TEST(Hybrid, ToleranceZeroIsTheSolutionWhereCracksStartLaterAndPiecesGoOn) {
  const std::string many = test::pulled_cube_text() + "max_cracks = 3\n";
  const RunResult solved = run(many, "bem", {}, nullptr, 4);
  EXPECT_GT(solved.cracks, 1);
  EXPECT_EQ(run(many, "hybrid", 0, nullptr, 4).document.hash, solved.document.hash);
  const std::string cracked = test::cracked_cube_text("", 0.1, 0.02);
  EXPECT_EQ(run(cracked, "hybrid", 0).document.hash, run(cracked, "bem").document.hash);
}

TEST(Hybrid, InfiniteToleranceIsThePrediction) {
  const std::string text = test::pulled_cube_text();
  EXPECT_EQ(run(text, "hybrid", kInfinity).document.hash, run(text, "kept").document.hash);
  EXPECT_EQ(run(text, "hybrid", kInfinity, &forest()).document.hash,
            run(text, "forest", {}, &forest()).document.hash);
}

TEST(Hybrid, BetweenItSolvesSomeFramesAndComesNearer) {
  const std::string text = test::pulled_cube_text();
  const RunResult kept = run(text, "kept"), hybrid = run(text, "hybrid", 0.08);
  const RunDocument& d = hybrid.document;
  EXPECT_GT(d.solved_frames, 1);
  EXPECT_LT(d.solved_frames, d.frames);
  EXPECT_LT(distance_from_solved(hybrid), 0.5 * distance_from_solved(kept));
  int solved = 0;
  double largest = 0;
  for (const FrameRecord& frame : d.timings) {
    ASSERT_TRUE(frame.expected_error);
    EXPECT_LE(*frame.expected_error, 0.08) << frame.frame;
    EXPECT_TRUE(frame.source == "bem" || frame.source == "kept");
    solved += frame.source == "bem";
    largest = std::max(largest, *frame.expected_error);
  }
  EXPECT_EQ(solved, d.solved_frames);
  EXPECT_EQ(d.expected_error, largest);
  EXPECT_EQ(run(text, "hybrid", 0.08).document.hash, d.hash);
}

TEST(Hybrid, WhatIsPredictedStaysSoAndWhatIsSolvedStaysSo) {
  for (const double expected : {0.0, 0.004, 0.006, 0.01, 0.011}) {
    EXPECT_EQ(may_predict(expected, 0.01, false), expected <= 0.01);
    EXPECT_EQ(may_predict(expected, 0.01, true), expected <= 0.005);
    EXPECT_TRUE(may_predict(expected, kInfinity, true));
  }
}

TEST(Hybrid, RunsWithoutToleranceEstimateNothing) {
  EXPECT_FALSE(solved_cube().document.expected_error);
  EXPECT_EQ(solved_cube().document.solved_frames, solved_cube().document.frames);
}

std::string refusal(const std::string& method, std::optional<double> tolerance) {
  return test::refusal([&] { checked_method(method, nullptr, tolerance); });
}

TEST(Hybrid, ToleranceBelongsToItAlone) {
  EXPECT_EQ(refusal("hybrid", {}), "accepted");
  EXPECT_EQ(refusal("hybrid", kInfinity), "accepted");
  for (const char* method : {"bem", "kept"})
    EXPECT_NE(refusal(method, 0.01).find("--method hybrid"), std::string::npos) << method;
  for (const double bad : {-0.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refusal("hybrid", bad).find("--tolerance"), std::string::npos) << bad;
}

}  // namespace
}  // namespace conchoid
