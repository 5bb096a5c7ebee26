#include "conchoid/learn/ridge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::synthetic_runs;
using test::TemporaryFolder;

/// Of mean zero and deviation one, near enough to normal for two deviations.
double noise(std::mt19937_64& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i)
    sum += test::uniform(random);
  return sum;
}

/// The synthetic samples with openings that follow from K, the toughness being fixed:
/// Δu/r̄ = c + M k + q k_I² + noise, k = K/√r̄.
SampleSet with_law(SampleSet samples, double quadratic, double deviation = 0) {
  std::mt19937_64 random(7);
  Mat3 m;
  m << 3, 0.5, -0.2, 0.1, 2, 0.4, -0.3, 0.2, 1;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    const Vec3 k = s.K / std::sqrt(s.resolution) / 1e8;
    Vec3 label = Vec3(0.1, -0.2, 0.3) + m * k + quadratic * k[0] * k[0] * Vec3(1, 1, -1);
    for (double& x : label)
      x += deviation * noise(random);
    for (std::size_t mode = 0; mode < 3; ++mode)
      samples.field(15 + mode)[i] = label[static_cast<Eigen::Index>(mode)] * s.resolution;
  }
  return samples;
}

void expect_same(const std::vector<OpeningPrediction>& a, const SampleSet& b, double tolerance) {
  for (std::size_t i = 0; i < b.size(); ++i)
    EXPECT_LT((a[i].opening - b[i].opening).norm(), tolerance * b[i].opening.norm()) << i;
}

TEST(Ridge, RecoversALinearLaw) {
  const SampleSet samples = with_law(synthetic_runs(10, 1, 1), 0);
  const auto ridge = RidgeRegression::train(samples.subset({0, 3, 5, 8, 100, 200, 300, 400, 500, 600}),
                                            {.degree = 1, .lambda = 1e-12});
  expect_same(ridge.predict_openings(samples), samples, 1e-8);
  EXPECT_LT(ridge.residual_deviation().norm(), 1e-8);
}

TEST(Ridge, RecoversAQuadraticLawOnlyWithProducts) {
  const SampleSet samples = with_law(synthetic_runs(10, 1, 1), 0.5);
  expect_same(RidgeRegression::train(samples, {.degree = 2, .lambda = 1e-12}).predict_openings(samples),
              samples, 1e-7);
  const auto linear = RidgeRegression::train(samples, {.degree = 1, .lambda = 1e-12});
  EXPECT_GT(linear.residual_deviation()[2], 0.05);
}

// What has no spread of its own (here the toughness) must not make the equations singular.
TEST(Ridge, ConstantFeaturesSayNothing) {
  const SampleSet samples = with_law(synthetic_runs(5, 1, 1), 0);
  SampleSet tougher = samples;
  for (double& K_c : tougher.field(3))
    K_c *= 3;
  const auto ridge =
      RidgeRegression::train(samples, {.features = FeatureSet::paper_4, .degree = 2, .lambda = 1e-9});
  const auto a = ridge.predict_openings(samples), b = ridge.predict_openings(tougher);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].opening, b[i].opening);
    EXPECT_TRUE(a[i].in_range);
    EXPECT_FALSE(b[i].in_range);
  }
}

TEST(Ridge, DoesNotCareForUnits) {
  const SampleSet samples = with_law(synthetic_runs(6, 1, 1), 0.3, 0.05);
  SampleSet other = samples;  // K and K_c in kPa√m
  for (const std::size_t f : {0u, 1u, 2u, 3u})
    for (double& x : other.field(f))
      x /= 1000;
  for (const std::optional<double> lambda : {std::optional<double>(0.01), std::optional<double>()}) {
    const RidgeSettings settings{.features = FeatureSet::paper_4, .degree = 2, .lambda = lambda};
    const auto one = RidgeRegression::train(samples, settings), two = RidgeRegression::train(other, settings);
    EXPECT_EQ(one.lambda(), two.lambda());
    const auto a = one.predict_openings(samples), b = two.predict_openings(other);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_LT((a[i].opening - b[i].opening).norm(), 1e-10 * a[i].opening.norm());
      EXPECT_LT((a[i].spread - b[i].spread).norm(), 1e-10 * a[i].spread.norm());
    }
  }
}

TEST(Ridge, TheSpreadCoversWhatItHasNotSeen) {
  const double deviation = 0.2;
  const SampleSet all = with_law(synthetic_runs(40, 1, 1), 0.3, deviation);
  const Split split = split_by_run(all, 0.5, 3);
  const auto ridge = RidgeRegression::train(split.training, {});
  const auto predicted = ridge.predict_openings(split.held_out);
  for (int mode = 0; mode < 3; ++mode) {
    std::size_t covered = 0;
    double mean = 0;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      const Sample s = split.held_out[i];
      covered += std::abs(predicted[i].opening[mode] - s.opening[mode]) < 2 * predicted[i].spread[mode];
      mean += predicted[i].spread[mode] / s.resolution / static_cast<double>(predicted.size());
    }
    const double share = static_cast<double>(covered) / static_cast<double>(predicted.size());
    EXPECT_GT(share, 0.93) << mode;
    EXPECT_LT(share, 0.975) << mode;
    EXPECT_NEAR(mean, deviation, 0.05 * deviation) << mode;
  }
}

TEST(Ridge, TheSpreadGrowsAwayFromTheTraining) {
  const auto ridge =
      RidgeRegression::train(with_law(synthetic_runs(10, 1, 1), 0, 0.1), {.degree = 1, .lambda = {}});
  FeatureMatrix rows = feature_matrix(synthetic_runs(1, 1, 1).subset({0}), FeatureSet::paper_4);
  const Prediction near = ridge.predict(rows.row(0));
  rows.values[0] *= 1000;
  const Prediction far = ridge.predict(rows.row(0));
  EXPECT_TRUE(near.in_range);
  EXPECT_FALSE(far.in_range);
  for (int mode = 0; mode < 3; ++mode)
    EXPECT_GT(far.spread[mode], 5 * near.spread[mode]);
  ASSERT_EQ(ridge.out_of_range(rows.row(0)).size(), 1u);
  EXPECT_NE(ridge.out_of_range(rows.row(0))[0].find("K_I/sqrt(r_bar)"), std::string::npos);
}

TEST(Ridge, ThePenaltyIsChosenByLeavingOutRuns) {
  EXPECT_LE(RidgeRegression::train(with_law(synthetic_runs(20, 1, 1), 0.3), {}).lambda(), 1e-7)
      << "an exact law needs no penalty";
  SampleSet nonsense = with_law(synthetic_runs(4, 1, 1), 0, 0);
  std::mt19937_64 random(3);
  for (const std::size_t f : {15u, 16u, 17u})
    for (double& x : nonsense.field(f))
      x = noise(random);
  EXPECT_EQ(RidgeRegression::train(nonsense.subset({0, 30, 70, 90, 140, 150, 210, 230}), {}).lambda(), 1)
      << "eight samples of noise and fourteen terms";
  EXPECT_EQ(RidgeRegression::train(with_law(synthetic_runs(1, 1, 1), 0), {}).lambda(), 1e-6)
      << "a single run";
}

TEST(Ridge, LearnsFromASingleSample) {
  const SampleSet one = synthetic_runs(1, 1, 1).subset({0});
  const auto p = RidgeRegression::train(one, {}).predict_openings(one);
  EXPECT_LT((p[0].opening - one[0].opening).norm(), 1e-12 * one[0].opening.norm());
}

TEST(Ridge, RefusesWhatItCannotLearn) {
  EXPECT_THROW(RidgeRegression::train({}, {}), InputError);
  EXPECT_THROW(RidgeRegression::train(synthetic_runs(1, 1, 1), {.degree = 3, .lambda = {}}), InputError);
  EXPECT_THROW(RidgeRegression::train(synthetic_runs(1, 1, 1), {.lambda = 0}), InputError);
  EXPECT_THROW(RidgeRegression::train(synthetic_runs(1, 1, 1), {.lambda = std::nan("")}), InputError);
}

TEST(Ridge, GivesTheSameBitsForEveryNumberOfThreads) {
  const TemporaryFolder folder;
  for (const int threads : {1, 2})
    ExecutionContext(threads).run([&] {
      RidgeRegression::train(with_law(synthetic_runs(12, 1, 1), 0.3, 0.1), {})
          .save(folder / std::to_string(threads));
    });
  EXPECT_EQ(read_bytes(folder / "1"), read_bytes(folder / "2"));
}

TEST(Ridge, ComesBackFromItsFile) {
  const TemporaryFolder folder;
  const auto ridge =
      RidgeRegression::train(with_law(synthetic_runs(5, 1, 1), 0.3, 0.1),
                             {.features = FeatureSet::dimensionless_context, .degree = 2, .lambda = {}}, {});
  ridge.save(folder / "a");
  const auto again = load_regressor(folder / "a");
  again->save(folder / "b");
  EXPECT_EQ(read_bytes(folder / "a"), read_bytes(folder / "b"));
  EXPECT_EQ(again->content_hash(), ridge.content_hash());
  EXPECT_EQ(again->name(), "ridge");
  const SampleSet samples = synthetic_runs(8, 1.3, 0.5);
  const auto a = ridge.predict_openings(samples), b = again->predict_openings(samples);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].opening, b[i].opening);
    EXPECT_EQ(a[i].spread, b[i].spread);
  }
}

TEST(Ridge, PredictsRowByRowAsInOneGo) {
  const auto ridge = RidgeRegression::train(with_law(synthetic_runs(5, 1, 1), 0.3, 0.1), {});
  const FeatureMatrix rows = feature_matrix(synthetic_runs(6, 1, 1), FeatureSet::paper_4);
  const auto together = ridge.predict(rows);
  for (std::size_t i = 0; i < rows.rows(); i += 7) {
    EXPECT_EQ(ridge.predict(rows.row(i)).mean, together[i].mean);
    EXPECT_EQ(ridge.predict(rows.row(i)).spread, together[i].spread);
  }
}

}  // namespace
}  // namespace conchoid
