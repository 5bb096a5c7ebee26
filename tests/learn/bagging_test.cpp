#include "conchoid/learn/bagging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::uniform;

struct Data {
  std::vector<float> rows;
  BaggingTarget target;
  std::size_t columns = 2;
  std::size_t size() const { return target.values.size(); }
};

Data wavy_data(std::size_t n, std::uint64_t seed = 5) {
  std::mt19937_64 random(seed);
  Data d;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = 2 * uniform(random) - 1, y = 2 * uniform(random) - 1;
    d.rows.push_back(static_cast<float>(x));
    d.rows.push_back(static_cast<float>(y));
    d.target.values.push_back(
        static_cast<float>(std::sin(3 * x) + 0.5 * y * y + 0.1 * (uniform(random) - 0.5)));
  }
  return d;
}

/// Best single split of a weighted least-squares fit, by trying every threshold of every feature.
struct Stump {
  std::size_t feature = 0;
  std::vector<bool> left;
  double left_value = 0, right_value = 0;
  double gain = -1;
};

Stump best_stump(const Data& d, const std::vector<std::uint32_t>& counts) {
  Stump best;
  for (std::size_t f = 0; f < d.columns; ++f)
    for (std::size_t k = 0; k < d.size(); ++k) {
      const float threshold = d.rows[k * d.columns + f];
      double n[2] = {0, 0}, sum[2] = {0, 0};
      std::vector<bool> left(d.size());
      for (std::size_t i = 0; i < d.size(); ++i) {
        left[i] = d.rows[i * d.columns + f] < threshold;
        n[left[i]] += counts[i];
        sum[left[i]] += counts[i] * static_cast<double>(d.target.values[i]);
      }
      if (n[0] == 0 || n[1] == 0) continue;
      const double gain = sum[0] * sum[0] / n[0] + sum[1] * sum[1] / n[1];
      if (gain > best.gain) best = {f, left, sum[1] / n[1], sum[0] / n[0], gain};
    }
  return best;
}

TEST(Bootstrap, DrawsAsManyAsThereAreWithReplacement) {
  const std::size_t n = 200000;
  const auto counts = bootstrap_counts(n, 7);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), n);
  // Counts follow a Poisson distribution of mean 1: e⁻¹/k! of the samples are drawn k times; ± 5 deviations
  // of a proportion.
  double expected = std::exp(-1.0);
  for (unsigned k = 0; k <= 4; ++k) {
    if (k > 0) expected /= k;
    const double share =
        static_cast<double>(std::count(counts.begin(), counts.end(), k)) / static_cast<double>(n);
    EXPECT_NEAR(share, expected, 5 * std::sqrt(expected / static_cast<double>(n)))
        << "drawn " << k << " times";
  }
}

TEST(Bootstrap, IsTheSameOnEveryMachineAndDiffersFromTreeToTree) {
  EXPECT_EQ(bootstrap_counts(8, 1), (std::vector<std::uint32_t>{2, 2, 1, 0, 1, 0, 2, 0}));
  EXPECT_NE(stream_seed(1, 0, 0), stream_seed(1, 0, 1));
  EXPECT_NE(stream_seed(1, 0, 1), stream_seed(1, 1, 0));
  EXPECT_NE(bootstrap_counts(100, stream_seed(1, 0, 0)), bootstrap_counts(100, stream_seed(1, 0, 1)));
}

TEST(Bagging, AStumpIsTheBestSplitThatBruteForceFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Data d = wavy_data(60, seed);
    const BaggingSettings settings{1, 1, seed, 1024};
    const auto trees = fit_bagged_trees(d.rows, d.columns, {d.target}, settings);
    const Stump oracle = best_stump(d, bootstrap_counts(d.size(), stream_seed(seed, 0, 0)));
    const TreeEnsemble ensemble(trees[0], 2);
    std::vector<TreeEnsemble::Answer> answers(d.size());
    ensemble.evaluate(d.rows, answers);
    const auto counts = bootstrap_counts(d.size(), stream_seed(seed, 0, 0));
    for (std::size_t i = 0; i < d.size(); ++i)
      if (counts[i] > 0) {
        EXPECT_NEAR(answers[i].mean, oracle.left[i] ? oracle.left_value : oracle.right_value, 1e-5)
            << "seed " << seed;
      }
  }
}

TEST(Bagging, ADeepTreeRemembersItsBootstrapSample) {
  const Data d = wavy_data(200);
  const auto trees = fit_bagged_trees(d.rows, d.columns, {d.target}, {1, 20, 3, 1024});
  std::vector<TreeEnsemble::Answer> answers(d.size());
  TreeEnsemble(trees[0], 2).evaluate(d.rows, answers);
  const auto counts = bootstrap_counts(d.size(), stream_seed(3, 0, 0));
  std::size_t remembered = 0, drawn = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (counts[i] == 0) continue;
    ++drawn;
    remembered += std::abs(answers[i].mean - static_cast<double>(d.target.values[i])) < 1e-4;
  }
  EXPECT_GE(remembered, drawn - 2);
}

TEST(Bagging, OwnEvaluationEqualsXgboost) {
  const Data d = wavy_data(5000);
  std::vector<std::vector<float>> oracle;
  const auto trees = fit_bagged_trees(d.rows, d.columns, {d.target}, {30, 10, 1, 256}, {}, &oracle);
  std::vector<TreeEnsemble::Answer> answers(d.size());
  const TreeEnsemble ensemble(trees[0], 2);
  ensemble.evaluate(d.rows, answers);
  EXPECT_EQ(ensemble.tree_count(), 30u);
  EXPECT_EQ(ensemble.depth(), 10);
  for (std::size_t i = 0; i < d.size(); ++i)
    EXPECT_NEAR(answers[i].mean, static_cast<double>(oracle[0][i]), 3e-6);
}

TEST(Bagging, TreesHaveTheSameBitsForEveryNumberOfThreads) {
  Data d = wavy_data(30000);
  for (std::size_t i = 0; i < d.size(); i += 100)
    d.target.values[i] *= 1000;  // heavy tail: rounding would show
  const auto fit = [&](int threads) {
    return ExecutionContext(threads).run([&] {
      return fit_bagged_trees(d.rows, d.columns, {d.target}, {6, 12, 1, 1024})[0];
    });
  };
  const auto one = fit(1), two = fit(2), four = fit(4);
  for (std::size_t t = 0; t < one.size(); ++t)
    for (const auto* other : {&two[t], &four[t]}) {
      EXPECT_EQ(one[t].left, other->left);
      EXPECT_EQ(one[t].feature, other->feature);
      EXPECT_EQ(one[t].threshold, other->threshold);
      EXPECT_EQ(one[t].value, other->value);
    }
}

TEST(Bagging, MeanAndSpreadAreThoseOfTheTrees) {
  const auto stump = [](float left, float right) {
    return RegressionTree{{0, -1, -1}, {1, -1, -1}, {2, -1, -1}, {0.5f, 0, 0}, {0, left, right}};
  };
  const TreeEnsemble ensemble({stump(1, 10), stump(3, 20), stump(8, 30)}, 1);
  const std::vector<float> rows = {0.25f, 0.5f};
  std::vector<TreeEnsemble::Answer> answers(2);
  ensemble.evaluate(rows, answers);
  EXPECT_DOUBLE_EQ(answers[0].mean, 4);
  EXPECT_DOUBLE_EQ(answers[0].spread, std::sqrt(13.0));
  EXPECT_DOUBLE_EQ(answers[1].mean, 20) << "the threshold itself belongs to the right side";
  EXPECT_DOUBLE_EQ(answers[1].spread, 10);
}

TEST(Bagging, RefusesTreesThatAreNone) {
  const auto tree = [](std::int32_t left, std::int32_t right, std::int32_t feature) {
    return RegressionTree{{feature, -1, -1}, {left, -1, -1}, {right, -1, -1}, {0.5f, 0, 0}, {0, 1, 2}};
  };
  EXPECT_NO_THROW(TreeEnsemble({tree(1, 2, 0)}, 1));
  EXPECT_THROW(TreeEnsemble({tree(0, 0, 0)}, 1), InputError) << "its own child";
  EXPECT_THROW(TreeEnsemble({tree(1, 3, 0)}, 1), InputError) << "child does not exist";
  EXPECT_THROW(TreeEnsemble({tree(1, 2, 1)}, 1), InputError) << "feature does not exist";
  EXPECT_THROW(TreeEnsemble({RegressionTree{}}, 1), InputError) << "no nodes";
}

TEST(Bagging, RefusesSettingsOutOfRange) {
  const Data d = wavy_data(10);
  for (const BaggingSettings& s :
       {BaggingSettings{0, 10, 1, 256}, {10, 0, 1, 256}, {10, 21, 1, 256}, {10, 10, 1, 1}, {-3, 10, 1, 256}})
    EXPECT_THROW(fit_bagged_trees(d.rows, d.columns, {d.target}, s), InputError);
}

}  // namespace
}  // namespace conchoid
