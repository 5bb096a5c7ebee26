#include "conchoid/sim/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/sim/run_identity.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

// Where the opening of a run comes from.
namespace conchoid {
namespace {

Scene cube() {
  return test::scene_from_text(test::pulled_cube_text());
}

RunResult run(const std::string& method, const Regressor* regressor = nullptr) {
  RunOptions options;
  options.method = method;
  options.regressor = regressor;
  options.progress = false;
  return run_scene(cube(), options);
}

const RunResult& solved() {
  static const RunResult result = run("bem");
  return result;
}

RegressionForest forest(int depth) {
  return RegressionForest::train(
      solved().samples,
      {.trees = 20, .depth = depth, .features = FeatureSet::dimensionless, .seed = 1, .bins = 64});
}

std::string refusal(const std::string& method, const Regressor* regressor = nullptr) {
  return test::refusal([&] { run(method, regressor); });
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(Methods, EveryKindOfRegressorIsOne) {
  for (const RegressorKind& kind : regressor_kinds())
    EXPECT_EQ(opening_method(kind.name).regressor, kind.name);
  EXPECT_TRUE(opening_method("bem").regressor.empty());
  for (const char* closed : {"steady", "kept", "stress", "hybrid"})
    EXPECT_TRUE(opening_method(closed).regressor.empty());
  EXPECT_EQ(opening_methods().size(), 5 + regressor_kinds().size());
  ASSERT_EQ(baseline_predictors().size(), 1u);
  EXPECT_EQ(baseline_predictors()[0]->name(), "steady");
  EXPECT_EQ(find_opening_method("magic"), nullptr);
}

TEST(Methods, WhatDoesNotGoTogetherIsRefused) {
  expect_parts(refusal("magic"), {"magic", "bem", "steady", "forest"});
  expect_parts(refusal("forest"), {"--method forest", "--database"});
  const RegressionForest any = forest(2);
  expect_parts(refusal("steady", &any), {"--method forest", "steady", "--database"});
  for (const RegressorKind& kind : regressor_kinds())
    if (kind.name != "forest")
      expect_parts(refusal(std::string(kind.name), &any), {std::string(kind.title), "--method forest"});
}

void expect_starts_solved(const RunResult& result, const std::string& method) {
  EXPECT_EQ(result.document.method, method);
  ASSERT_GE(result.document.timings.size(), 2u);
  EXPECT_EQ(result.document.timings[0].source, "bem");
  EXPECT_EQ(result.document.timings[1].source, method);
  ASSERT_EQ(result.front[0].frame, 1);
  EXPECT_EQ(result.front[0].intensity, solved().front[0].intensity);
}

TEST(Methods, SteadyPredictionBreaksTheCubeAndIsRepeatable) {
  const RunResult result = run("steady");
  expect_starts_solved(result, "steady");
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_EQ(result.fragments.size(), 2u);
  EXPECT_EQ(run("steady").document.hash, result.document.hash);
}

// One run is far too little to learn from: what counts here is that the run starts as the solved one does,
// breaks the cube and is repeatable.
TEST(Methods, RegressorsPredictFromTheSecondFrameOn) {
  ASSERT_GT(solved().samples.size(), 20u);
  for (const RegressorKind& kind : regressor_kinds()) {
    const auto regressor = train_regressor(kind, solved().samples,
                                           {.features = FeatureSet::dimensionless, .seed = 1, .options = {}});
    const RunResult result = run(std::string(kind.name), regressor.get());
    expect_starts_solved(result, std::string(kind.name));
    EXPECT_EQ(result.document.stop, StopReason::separated) << kind.name;
    EXPECT_EQ(result.fragments.size(), 2u) << kind.name;
    EXPECT_EQ(run(std::string(kind.name), regressor.get()).document.hash, result.document.hash) << kind.name;
  }
}

// What it looks at around the front is measured as the run goes on, as it was for its samples.
TEST(Methods, ARegressorThatLooksAroundPredictsKOfTheFrontItself) {
  const Scene scene = cube();
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  SampleRecorder recorder(SampleRecorder::Fields::all);
  fracture.add_observer(recorder);
  while (fracture.step().moving) {
  }
  const SampleSet samples = recorder.take();
  for (const FeatureSet set : {FeatureSet::versatile, FeatureSet::dimensionless_context}) {
    const RegressionForest forest =
        RegressionForest::train(samples, {.trees = 20, .depth = 8, .features = set, .seed = 1, .bins = 64});
    const RunResult result = run("forest", &forest);
    expect_starts_solved(result, "forest");
    EXPECT_EQ(result.document.stop, StopReason::separated) << name(set);
    EXPECT_EQ(run("forest", &forest).document.hash, result.document.hash) << name(set);
  }
}

TEST(Methods, AnotherForestOfTheSameSamplesIsAnotherRun) {
  const Scene scene = cube();
  const PreparedBody body = prepare(scene);
  const RegressionForest shallow = forest(2), same = forest(2), deep = forest(8);
  const auto identity = [&](const Regressor& regressor) {
    RunOptions options;
    options.method = "forest";
    options.regressor = &regressor;
    return run_identity(scene, body, load_of(scene, body), options);
  };
  EXPECT_EQ(shallow.provenance().samples_hash, deep.provenance().samples_hash);
  EXPECT_EQ(identity(shallow), identity(same));
  EXPECT_NE(identity(shallow), identity(deep));
}

}  // namespace
}  // namespace conchoid
