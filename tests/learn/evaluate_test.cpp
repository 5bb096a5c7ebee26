#include "conchoid/learn/evaluate.hpp"

#include <gtest/gtest.h>

#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/exclusion.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/summary.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::synthetic_runs;

RegressionForest train(const SampleSet& samples, FeatureSet set) {
  ForestSettings settings;
  settings.trees = 20;
  settings.features = set;
  return RegressionForest::train(samples, settings);
}

std::set<std::int32_t> runs_of(const SampleSet& samples) {
  return {samples.run().begin(), samples.run().end()};
}

TEST(Split, HoldsOutWholeRuns) {
  const SampleSet all = synthetic_runs(30, 1, 1);
  const Split split = split_by_run(all, 0.2, 9);
  EXPECT_EQ(runs_of(split.held_out).size(), 6u);
  EXPECT_EQ(runs_of(split.training).size(), 24u);
  EXPECT_EQ(split.training.size() + split.held_out.size(), all.size());
  for (const std::int32_t run : runs_of(split.held_out))
    EXPECT_FALSE(runs_of(split.training).contains(run));
  EXPECT_EQ(split_by_run(all, 0.2, 9).held_out, split.held_out);
  EXPECT_NE(runs_of(split_by_run(all, 0.2, 10).held_out), runs_of(split.held_out));
  EXPECT_EQ(runs_of(split_by_run(all, 0.001, 1).held_out).size(), 1u);
  EXPECT_EQ(runs_of(split_by_run(all, 0.999, 1).training).size(), 1u);
  EXPECT_THROW(split_by_run(all, 0, 1), InputError);
  EXPECT_THROW(split_by_run(synthetic_runs(1, 1, 1), 0.5, 1), InputError);
}

TEST(Evaluate, SteadyIsPerfectWhereIntensitiesStay) {
  const Split split = split_by_run(synthetic_runs(20, 1, 1), 0.25, 1);
  const Evaluation e = evaluate(train(split.training, FeatureSet::dimensionless), split.held_out);
  EXPECT_EQ(e.samples, split.held_out.size());
  EXPECT_EQ(e.runs, 5u);
  for (int mode = 0; mode < 3; ++mode) {
    EXPECT_NEAR(e.baselines[0].accuracy.r2[mode], 1, 1e-12);
    EXPECT_NEAR(e.model.accuracy.r2[mode], 1, 1e-9) << "the correction to learn is zero";
  }
  const Evaluation paper = evaluate(train(split.training, FeatureSet::paper_4), split.held_out);
  EXPECT_LT(paper.model.accuracy.r2[0], e.model.accuracy.r2[0]);
  EXPECT_GT(paper.model.accuracy.rmse[0], paper.baselines[0].accuracy.rmse[0]);
}

TEST(Evaluate, ALearnedChangeBeatsSteady) {
  const Split split = split_by_run(synthetic_runs(40, 1.3, -0.5), 0.25, 1);
  const RegressionForest forest = train(split.training, FeatureSet::dimensionless);
  const Evaluation e = evaluate(forest, split.held_out);
  EXPECT_GT(e.model.accuracy.r2[0], e.baselines[0].accuracy.r2[0]);
  EXPECT_GT(e.model.accuracy.r2[1], e.baselines[0].accuracy.r2[1]);
  EXPECT_LT(e.baselines[0].accuracy.r2[1], 0) << "the steady sign of mode II is wrong here";
  EXPECT_LT(e.model.accuracy.rmse[0], 0.2 * e.baselines[0].accuracy.rmse[0]);
  EXPECT_FALSE(e.seen_in_training);
  EXPECT_TRUE(evaluate(forest, split.training).seen_in_training);
  EXPECT_EQ(evaluate(forest, split.training).model.in_range, split.training.size());
  EXPECT_THROW(evaluate(forest, {}), InputError);
}

TEST(Evaluate, FiguresAreThoseOfTheirDefinition) {
  SampleSet samples;
  for (const double opening : {1.0, 2.0, 3.0}) {
    Sample s;
    s.resolution = 2;
    s.opening = {opening, 5, 0};
    samples.add(s);
  }
  const Accuracy a = accuracy(samples, {{1, 5, 1}, {2, 5, 1}, {5, 5, 1}});
  EXPECT_DOUBLE_EQ(a.rmse[0], std::sqrt(1.0 / 3));
  EXPECT_DOUBLE_EQ(a.r2[0], 1 - 4.0 / 2);
  EXPECT_EQ(a.r2[1], 1);
  EXPECT_EQ(a.r2[2], 0);
}

TEST(Evaluate, SpeaksTheJsonOfTheContract) {
  const SampleSet samples = synthetic_runs(4, 1.1, 0.5);
  const std::string text = json_text(evaluate(train(samples, FeatureSet::paper_3), samples));
  for (const char* key : {"\"samples\"", "\"rmse\"", "\"r2\"", "\"baseline_steady\"", "\"I\"", "\"III\""})
    EXPECT_NE(text.find(key), std::string::npos) << key;
  const std::string about = json_text(train(samples, FeatureSet::paper_3));
  EXPECT_NE(about.find("paper-3"), std::string::npos);
}

TEST(Exclusion, FollowsThePublishedRules) {
  RunSummary good;
  good.alpha = 45;
  good.frames = 15;
  good.cracks = 1;
  good.largest_growth = 1;
  good.resolution = 0.1;
  EXPECT_EQ(exclusion_reason(good), "");
  const auto reason = [&](auto change) {
    RunSummary run = good;
    change(run);
    return exclusion_reason(run);
  };
  EXPECT_NE(reason([](RunSummary& r) { r.alpha = 89; }).find("near 90"), std::string::npos);
  EXPECT_NE(reason([](RunSummary& r) { r.frames = 32; }).find("31 frames"), std::string::npos);
  EXPECT_NE(reason([](RunSummary& r) { r.stopped = false; }).find("did not stop"), std::string::npos);
  EXPECT_NE(reason([](RunSummary& r) { r.cracks = 0; }).find("no crack"), std::string::npos);
  EXPECT_NE(reason([](RunSummary& r) { r.cracks = 8, r.largest_growth = 0.1; }).find("8 cracks"),
            std::string::npos);
  EXPECT_EQ(reason([](RunSummary& r) { r.cracks = 8; }), "") << "one of the eight grew";
  EXPECT_EQ(reason([](RunSummary& r) { r.largest_growth = 0.1; }), "") << "a single small crack";
  EXPECT_EQ(reason([](RunSummary& r) { r.frames = 31; }), "");
}

}  // namespace
}  // namespace conchoid
