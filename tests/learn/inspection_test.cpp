#include "conchoid/learn/inspection.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "synthetic.hpp"

// What a regressor looks at, and how far its training covers other samples.
namespace conchoid {
namespace {

SampleSet runs(int first, int count, double load = 1) {
  SampleSet set;
  for (int run = first; run < first + count; ++run)
    set.append(test::synthetic_run(run, 8, 10, 1.2, 0.5));
  for (std::size_t f = 0; f < 3; ++f)
    for (double& K : set.field(f))
      K *= load;
  for (std::size_t f = SampleSet::field_count - 3; f < SampleSet::field_count; ++f)
    for (double& opening : set.field(f))
      opening *= load;
  return set;
}

const Regressor& ridge(FeatureSet set) {
  const auto train = [](FeatureSet features) {
    return train_regressor(regressor_kind("ridge"), runs(0, 40),
                           {.features = features, .seed = 1, .options = {}});
  };
  static const auto paper = train(FeatureSet::paper_4), dimensionless = train(FeatureSet::dimensionless);
  return set == FeatureSet::paper_4 ? *paper : *dimensionless;
}

TEST(FeatureInfluence, EachModeFollowsItsOwnIntensity) {
  const auto influences = feature_influences(ridge(FeatureSet::paper_4), runs(40, 10));
  ASSERT_EQ(influences.size(), 4u);
  for (int mode = 0; mode < 3; ++mode)
    for (int other = 0; other < 3; ++other) {
      if (other == mode) continue;
      EXPECT_GT(influences[static_cast<std::size_t>(mode)].importance[mode],
                5 * influences[static_cast<std::size_t>(other)].importance[mode])
          << mode << " " << other;
    }
  EXPECT_EQ(influences[3].name, "K_c");
  EXPECT_NEAR(influences[3].importance.norm(), 0, 1e-12);  // the same everywhere
  EXPECT_EQ(influences[3].dependence.size(), 1u);
}

TEST(FeatureInfluence, MoreOpeningWhereKIsLarger) {
  const auto influences = feature_influences(ridge(FeatureSet::paper_4), runs(40, 10));
  const auto& dependence = influences[0].dependence;
  ASSERT_EQ(dependence.size(), FeatureRange::levels.size());
  for (std::size_t i = 1; i < dependence.size(); ++i) {
    EXPECT_GT(dependence[i].value, dependence[i - 1].value);
    EXPECT_GT(dependence[i].mean[0], dependence[i - 1].mean[0]);
  }
}

TEST(FeatureInfluence, IsRepeatable) {
  const auto a = feature_influences(ridge(FeatureSet::dimensionless), runs(40, 10)),
             b = feature_influences(ridge(FeatureSet::dimensionless), runs(40, 10));
  for (std::size_t f = 0; f < a.size(); ++f)
    EXPECT_EQ(a[f].importance, b[f].importance) << a[f].name;
}

TEST(RangeCoverage, OfTheTrainingItselfIsWhole) {
  const RangeCoverage c = range_coverage(ridge(FeatureSet::paper_4), runs(0, 40));
  EXPECT_EQ(c.in_range, c.samples);
  for (const RangeCoverage::Feature& f : c.features) {
    EXPECT_EQ(f.outside, 0) << f.name;
    EXPECT_LE(f.in_the_tails, 0.025) << f.name;
  }
}

TEST(RangeCoverage, TellsWhichFeatureLeavesTheRange) {
  const RangeCoverage c = range_coverage(ridge(FeatureSet::paper_4), runs(40, 5, 100));
  EXPECT_LT(c.in_range, c.samples / 2);
  EXPECT_GT(c.features[0].outside, 0.5);
  EXPECT_EQ(c.features[3].outside, 0);
  EXPECT_GT(c.features[0].median, c.features[0].training_median);
}

TEST(NeighbourCoverage, OfOtherRunsOfTheSameKindIsNearlyWhole) {
  const NeighbourCoverage c = neighbour_coverage(ridge(FeatureSet::dimensionless), runs(0, 40), runs(40, 10));
  EXPECT_GT(c.covered, 0.85);
  EXPECT_LT(c.median, 1.5 * c.own_median);
}

// The same features, but K_II goes on by another rule.
TEST(NeighbourCoverage, TellsWhatFollowsOtherwiseFromTheSameFeatures) {
  SampleSet other;
  for (int run = 40; run < 50; ++run)
    other.append(test::synthetic_run(run, 8, 10, 1.2, -1));
  const NeighbourCoverage same = neighbour_coverage(ridge(FeatureSet::paper_4), runs(0, 40), runs(40, 10)),
                          turned = neighbour_coverage(ridge(FeatureSet::paper_4), runs(0, 40), other);
  EXPECT_EQ(turned.covered, same.covered);
  EXPECT_NEAR(turned.labels_apart[0], same.labels_apart[0], 1e-9);
  EXPECT_GT(turned.labels_apart[1], 2 * same.labels_apart[1]);
  EXPECT_LT(same.labels_apart[1], 2 * same.own_labels_apart[1]);
}

TEST(NeighbourCoverage, OfOtherLoadsIsNone) {
  const NeighbourCoverage c = neighbour_coverage(ridge(FeatureSet::paper_4), runs(0, 40), runs(40, 10, 1000));
  EXPECT_LT(c.covered, 0.05);
  EXPECT_GT(c.median, c.own_p95);
}

TEST(Inspection, NeedsSamplesAndSeveralRuns) {
  EXPECT_THROW(feature_influences(ridge(FeatureSet::paper_4), {}), InputError);
  EXPECT_THROW(range_coverage(ridge(FeatureSet::paper_4), {}), InputError);
  EXPECT_THROW(neighbour_coverage(ridge(FeatureSet::paper_4), runs(0, 1), runs(40, 1)), InputError);
}

}  // namespace
}  // namespace conchoid
