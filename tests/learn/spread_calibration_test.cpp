#include "conchoid/learn/spread_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "synthetic.hpp"

// What a stated spread is worth.
namespace conchoid {
namespace {

using test::synthetic_runs;
using test::TemporaryFolder;

TEST(SpreadCalibration, FollowsItsKnots) {
  EXPECT_EQ(SpreadCalibration()(0.3), 0.3);  // nothing is known: as stated
  const SpreadCalibration c({{0.01, 0.04}, {0.04, 0.06}, {0.09, 0.3}});
  EXPECT_DOUBLE_EQ(c(0.001), 0.04);
  EXPECT_DOUBLE_EQ(c(0.01), 0.04);
  EXPECT_NEAR(c(0.02), std::sqrt(0.04 * 0.06), 1e-15);  // half way in the logarithms
  EXPECT_NEAR(c(0.04), 0.06, 1e-15);
  EXPECT_NEAR(c(0.06), std::sqrt(0.06 * 0.3), 1e-15);
  EXPECT_NEAR(c(0.18), 0.6, 1e-15);
  EXPECT_EQ(c(0), 0);
}

TEST(SpreadCalibration, RefusesKnotsThatDoNotRise) {
  for (const std::vector<SpreadCalibration::Knot>& bad :
       {std::vector<SpreadCalibration::Knot>{{0.1, 0.2}, {0.1, 0.3}},
        {{0.1, 0.2}, {0.2, 0.1}},
        {{0, 0.1}},
        {{0.1, 0}},
        {{0.1, std::nan("")}}})
    EXPECT_THROW(SpreadCalibration{bad}, InputError);
}

// Errors of deviation 3 s^0.6 where s is stated.
TEST(SpreadCalibration, FindsTheErrorThatBelongsToAStatement) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto truth = [](double s) { return 3 * std::pow(s, 0.6); };
  std::vector<double> stated, errors;
  for (int i = 0; i < 40000; ++i) {
    stated.push_back(std::pow(10.0, -3 + 2 * test::uniform(random)));
    errors.push_back(truth(stated.back()) * normal(random));
  }
  const SpreadCalibration c = SpreadCalibration::measure(stated, errors);
  EXPECT_EQ(c.knots().size(), 10u);
  for (const double s : {0.002, 0.01, 0.03, 0.07})
    EXPECT_NEAR(c(s) / truth(s), 1, 0.05) << s;
  // The same in another unit.
  for (std::vector<double>* all : {&stated, &errors})
    for (double& x : *all)
      x *= 7;
  EXPECT_NEAR(SpreadCalibration::measure(stated, errors)(0.07), 7 * c(0.01), 1e-12);
}

TEST(SpreadCalibration, FewSamplesMakeFewKnotsAndFewerNone) {
  const std::vector<double> stated(120, 0.1), errors(120, 0.2);
  const SpreadCalibration c = SpreadCalibration::measure(stated, errors);
  ASSERT_EQ(c.knots().size(), 1u);  // two groups state the same
  EXPECT_NEAR(c(0.1), 0.2, 1e-15);
  const std::span<const double> few = std::span(stated).first(49), few_errors = std::span(errors).first(49);
  EXPECT_THROW(SpreadCalibration::measure(few, few_errors), InputError);
  EXPECT_THROW(SpreadCalibration::measure(std::vector<double>(120, 0.0), errors), InputError);
  EXPECT_THROW(SpreadCalibration::measure(stated, std::vector<double>(120, 0.0)), InputError);
}

TEST(SpreadCalibration, OfEveryKindOfRegressorIsKeptInItsFile) {
  const TemporaryFolder folder;
  for (const RegressorKind& kind : regressor_kinds()) {
    TrainingSettings settings;
    settings.features = FeatureSet::dimensionless;
    if (kind.name == "network") settings.options = {{"width", 4}, {"epochs", 2}};
    const SampleSet seen = synthetic_runs(10, 1.1, 0.5), unseen = synthetic_runs(12, 1.2, 0.5);
    const auto regressor = train_regressor(kind, seen, settings);
    const std::vector<Prediction> before = regressor->predict_labels(unseen);
    EXPECT_FALSE(regressor->calibrated());
    EXPECT_THROW(regressor->calibrate(seen), InputError) << kind.name;
    regressor->calibrate(unseen);
    EXPECT_TRUE(regressor->calibrated());
    const std::vector<Prediction> after = regressor->predict_labels(unseen);
    // What is stated is now what was found, over all; the answer is as it was.
    double stated = 0, found = 0;
    for (std::size_t i = 0; i < unseen.size(); ++i) {
      EXPECT_EQ(before[i].mean, after[i].mean);
      stated += after[i].spread[0] * after[i].spread[0];
      found += std::pow(label(unseen[i], settings.features)[0] - after[i].mean[0], 2);
    }
    EXPECT_NEAR(stated / found, 1, 0.35) << kind.name;
    regressor->save(folder / "calibrated");
    const auto again = load_regressor(folder / "calibrated");
    EXPECT_EQ(again->record().calibration, regressor->record().calibration);
    EXPECT_EQ(again->content_hash(), regressor->content_hash());
  }
}

}  // namespace
}  // namespace conchoid
