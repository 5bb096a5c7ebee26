#include "conchoid/learn/boosted_trees.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/random.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::synthetic_runs;

struct Values {
  std::vector<float> rows, target;
};

/// y = x₀ + ½ sin 3x₁ + noise over the square of side 2.
Values wavy(std::size_t n, double noise, std::uint64_t seed) {
  Random random(seed);
  Values v;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    v.rows.push_back(static_cast<float>(x));
    v.rows.push_back(static_cast<float>(y));
    v.target.push_back(static_cast<float>(x + 0.5 * std::sin(3 * y) + noise * random.normal()));
  }
  return v;
}

double mean_square(const BoostedMember& member, const Values& v) {
  const TreeEnsemble trees(member, 2);
  std::vector<TreeEnsemble::Answer> answers(v.target.size());
  trees.evaluate(v.rows, answers);
  double sum = 0;
  for (std::size_t i = 0; i < answers.size(); ++i)
    sum += std::pow(
        answers[i].mean * static_cast<double>(trees.tree_count()) - static_cast<double>(v.target[i]), 2);
  return sum / static_cast<double>(answers.size());
}

TEST(Boosting, TheSumOfTheTreesIsTheAnswer) {
  const Values v = wavy(2000, 0, 1), fresh = wavy(500, 0, 2);
  const auto fitted = fit_boosted_trees(v.rows, 2, {v.target}, RunGroups{std::vector<int>(2000, 0)},
                                        {.trees = 200, .leaf = 5});
  ASSERT_EQ(fitted[0].size(), 1U) << "nothing to leave out: one member";
  EXPECT_EQ(fitted[0][0].size(), 200U) << "and all of its trees";
  EXPECT_LT(mean_square(fitted[0][0], v), 1e-3);
  EXPECT_LT(mean_square(fitted[0][0], fresh), 5e-3);
}

// With noise, more trees make it worse after a while: the group left out says when.
TEST(Boosting, StopsWhereWhatIsLeftOutGetsWorse) {
  const Values v = wavy(800, 0.5, 3), fresh = wavy(4000, 0, 4);
  RunGroups groups{std::vector<int>(800), 2};
  for (std::size_t i = 0; i < groups.of_row.size(); ++i)
    groups.of_row[i] = static_cast<int>(i % 2);
  const BoostingSettings settings{.trees = 400, .leaf = 5};
  const auto stopped = fit_boosted_trees(v.rows, 2, {v.target}, groups, settings);
  const auto all = fit_boosted_trees(v.rows, 2, {v.target}, RunGroups{std::vector<int>(800, 0)}, settings);
  for (const BoostedMember& member : stopped[0]) {
    EXPECT_LT(member.size(), 100U);
    EXPECT_LT(mean_square(member, fresh), mean_square(all[0][0], fresh));
  }
}

TEST(Boosting, HasTheSameBitsForEveryNumberOfThreads) {
  const SampleSet samples = synthetic_runs(12, 1.1, 0.5);
  const auto hash_of = [&](int threads) {
    std::uint64_t hash = 0;
    ExecutionContext(threads).run(
        [&] { hash = BoostedTrees::train(samples, FeatureSet::paper_3, {.trees = 20}).content_hash(); });
    return hash;
  };
  EXPECT_EQ(hash_of(1), hash_of(2));
}

// Members that were fitted without a group of runs each nearly agree where a law is simple.
TEST(Boosting, TheSpreadIsWhatMembersDifferBy) {
  const SampleSet samples = synthetic_runs(40, 1.3, -0.5);
  const auto trees = BoostedTrees::train(samples, FeatureSet::dimensionless, {.trees = 100});
  ASSERT_EQ(trees.members(0).size(), 4U);
  const auto predicted = trees.predict_labels(samples);
  for (const Prediction& p : predicted)
    for (int mode = 0; mode < 3; ++mode)
      EXPECT_GE(p.spread[mode], 0);
  double known = 0;
  for (const Prediction& p : predicted)
    known += p.spread[0] / static_cast<double>(predicted.size());
  EXPECT_GT(known, 0);
  EXPECT_LT(known, 0.1);
}

}  // namespace
}  // namespace conchoid
