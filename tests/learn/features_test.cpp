#include "conchoid/learn/features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "conchoid/core/error.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

TEST(Features, AreNamedByNameOrByHowTheyBegin) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(named_features(FeatureSet::versatile, {"turn*", "w_II"}),
            (Names{"w_II", "turn_21", "turn_31", "turn_23"}));
  EXPECT_EQ(named_features(FeatureSet::paper_4, {"K_c"}), Names{"K_c"});
  EXPECT_TRUE(named_features(FeatureSet::paper_4, {}).empty());
  EXPECT_THROW(named_features(FeatureSet::paper_4, {"wall*"}), InputError);
  EXPECT_THROW(named_features(FeatureSet::paper_4, {"K_c*", "K_I*"}), InputError);  // nothing left
  FeatureMatrix rows{FeatureSet::paper_4, 4, {1, 2, 3, 4, 5, 6, 7, 8}, {}};
  hide_features(rows, {"K_c"});
  EXPECT_EQ(rows.values, (std::vector<double>{1, 2, 3, 0, 5, 6, 7, 0}));
}

using test::synthetic_runs;

std::vector<double> row_of(const Sample& s, FeatureSet set) {
  std::vector<double> row(feature_count(set));
  features(s, set, row);
  return row;
}

Sample generic_sample() {
  Sample s = synthetic_runs(1, 1.1, 0.3)[17];
  s.front_curvature = 2.5;
  return s;
}

/// Size × s, E × k, stress × k.
Sample scaled(Sample x, double s, double k) {
  const double intensity = k * std::sqrt(s);
  x.K *= intensity;
  x.toughness *= intensity;
  x.youngs_modulus *= k;
  x.traction *= k;
  for (double* length :
       {&x.resolution, &x.distance_before, &x.distance_after, &x.travelled, &x.surface_distance})
    *length *= s;
  x.front_curvature /= s;
  x.opening *= s;
  return x;
}

TEST(Features, APhysicallyScaledCopyLooksTheSame) {
  const Sample a = generic_sample();
  for (const FeatureSet set : {FeatureSet::dimensionless, FeatureSet::dimensionless_context}) {
    for (const auto& [s, k] : {std::pair{100.0, 1000.0}, {1e-3, 7.0}, {3.0, 1e-6}}) {
      const Sample b = scaled(a, s, k);
      const auto row_a = row_of(a, set), row_b = row_of(b, set);
      for (std::size_t i = 0; i < row_a.size(); ++i)
        EXPECT_NEAR(row_a[i], row_b[i], 1e-13 * (1 + std::abs(row_a[i]))) << feature_names(set)[i];
      EXPECT_NEAR((label(a, set) - label(b, set)).norm(), 0, 1e-13);
      EXPECT_NEAR(
          (s * opening_from_label(a, set, {0.1, 0.2, 0.3}) - opening_from_label(b, set, {0.1, 0.2, 0.3}))
              .norm(),
          0, 1e-13 * s);
    }
    EXPECT_EQ(row_of(a, set), row_of(scaled(a, 4, 64), set)) << "powers of four change no bit";
    EXPECT_EQ(label(a, set), label(scaled(a, 4, 64), set));
  }
}

TEST(Features, ThePublishedSetsAreTiedToMaterialAndSize) {
  const Sample a = generic_sample();
  EXPECT_NE(row_of(a, FeatureSet::paper_4), row_of(scaled(a, 100, 1), FeatureSet::paper_4));
  const auto row = row_of(a, FeatureSet::paper_5);
  EXPECT_DOUBLE_EQ(row[1], a.K[1] / std::sqrt(a.resolution));
  EXPECT_DOUBLE_EQ(row[3], a.toughness);
  EXPECT_DOUBLE_EQ(row[4], a.travelled);
  EXPECT_DOUBLE_EQ(label(a, FeatureSet::paper_3)[2], a.opening[2] / a.resolution);
}

/// All but `versatile`, whose label is no opening (versatile_features_test.cpp).
std::vector<FeatureSet> sets_of_openings() {
  std::vector<FeatureSet> sets = all_feature_sets();
  std::erase(sets, FeatureSet::versatile);
  return sets;
}

TEST(Features, LabelsGoBackToTheOpeningTheyCameFrom) {
  const SampleSet samples = synthetic_runs(3, 1.2, -0.4);
  for (const FeatureSet set : sets_of_openings())
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Sample s = samples[i];
      EXPECT_LT((opening_from_label(s, set, label(s, set)) - s.opening).norm(), 1e-12 * s.opening.norm());
    }
}

TEST(Features, SteadyPredictionIsTheZeroOfTheDimensionlessLabel) {
  const SampleSet steady = synthetic_runs(2, 1, 1);
  for (std::size_t i = 0; i < steady.size(); ++i) {
    EXPECT_LT(label(steady[i], FeatureSet::dimensionless).norm(), 1e-12);
    EXPECT_LT(
        (steady_opening(steady[i]) - opening_from_label(steady[i], FeatureSet::dimensionless, Vec3::Zero()))
            .norm(),
        1e-15 * steady[i].opening.norm());
  }
}

TEST(Features, MirroringAndReversingTheNormalChangeOnlyTheSignsOfTheAnswer) {
  const Sample a = generic_sample();
  for (const FeatureSet set : {FeatureSet::dimensionless, FeatureSet::dimensionless_context})
    for (const Vec3& sign : {Vec3(1, -1, 1), Vec3(1, 1, -1), Vec3(1, -1, -1)}) {
      Sample b = a;
      b.K = a.K.cwiseProduct(sign);
      b.traction = a.traction.cwiseProduct(sign);
      b.opening = a.opening.cwiseProduct(sign);
      EXPECT_EQ(row_of(a, set), row_of(b, set));
      EXPECT_EQ(label(a, set), label(b, set));
      const Vec3 answer = opening_from_label(a, set, {0.1, -0.2, 0.3});
      EXPECT_EQ(opening_from_label(b, set, {0.1, -0.2, 0.3}), Vec3(answer.cwiseProduct(sign)));
    }
}

TEST(Features, SpreadIsTheSizeOfAOneDeviationStep) {
  const Sample s = generic_sample();
  for (const FeatureSet set : sets_of_openings()) {
    const Vec3 step = opening_from_label(s, set, {0.3, 0.2, 0.1}) - opening_from_label(s, set, Vec3::Zero());
    EXPECT_LT((opening_spread(s, set, {0.3, 0.2, 0.1}) - step.cwiseAbs()).norm(), 1e-12 * step.norm());
  }
}

TEST(Features, NamesAndNumbersAgree) {
  for (const FeatureSet set : all_feature_sets()) {
    EXPECT_EQ(feature_names(set).size(), feature_count(set));
    EXPECT_EQ(label_names(set).size(), 3);
    EXPECT_EQ(feature_set_from_name(name(set)), set);
  }
  try {
    feature_set_from_name("paper-6");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("paper-4"), std::string::npos) << "the known names are listed";
  }
}

TEST(Features, AnInfiniteBodyHasNoSurfaceToFeel) {
  Sample s = generic_sample();
  s.surface_distance = std::numeric_limits<double>::infinity();
  EXPECT_EQ(row_of(s, FeatureSet::dimensionless_context)[10], 0);
}

TEST(SampleSet, KeepsSamplesFieldByField) {
  const SampleSet set = synthetic_runs(2, 1.1, 0.5);
  SampleSet copy;
  for (std::size_t i = 0; i < set.size(); ++i)
    copy.add(set[i]);
  EXPECT_EQ(copy, set);
  EXPECT_EQ(copy.hash(), set.hash());
  SampleSet other = copy;
  other.field(4)[3] = std::nextafter(other.field(4)[3], 1e9);
  EXPECT_NE(other.hash(), set.hash());
  EXPECT_EQ(set.subset({5, 2})[1].K, set[2].K);
  EXPECT_EQ(SampleSet::fields()[15].name, "opening_I");
  EXPECT_EQ(set.field(15)[7], set[7].opening[0]);
}

TEST(SampleSet, NamesTheSampleThatIsWrong) {
  SampleSet set = synthetic_runs(1, 1, 1);
  EXPECT_NO_THROW(set.validate());
  Sample bad = set[3];
  bad.K[1] = std::nan("");
  bad.frame = 77;
  set.add(bad);
  try {
    set.validate();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("frame 77"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("K_II"), std::string::npos);
  }
}

}  // namespace
}  // namespace conchoid
