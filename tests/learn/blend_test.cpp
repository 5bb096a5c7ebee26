#include "conchoid/learn/blend.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/learn/regressor_kinds.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::synthetic_runs;

TEST(Blend, IsTheMeanOfItsMembers) {
  const SampleSet samples = synthetic_runs(12, 1.2, 0.5);
  const Blend blend = Blend::train(samples, FeatureSet::dimensionless, 1);
  ASSERT_EQ(blend.members().size(), 3U);
  const FeatureMatrix rows = feature_matrix(samples, FeatureSet::dimensionless);
  const std::vector<Prediction> all = blend.predict(rows);
  std::vector<std::vector<Prediction>> of_member;
  for (const auto& member : blend.members())
    of_member.push_back(member->predict(rows));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (int mode = 0; mode < 3; ++mode) {
      double mean = 0, square = 0;
      for (const auto& p : of_member)
        mean += p[i].mean[mode] / 3;
      for (const auto& p : of_member)
        square += (std::pow(p[i].spread[mode], 2) + std::pow(p[i].mean[mode] - mean, 2)) / 3;
      EXPECT_NEAR(all[i].mean[mode], mean, 1e-12 * (1 + std::abs(mean)));
      EXPECT_NEAR(all[i].spread[mode], std::sqrt(square), 1e-6 * std::sqrt(square) + 1e-8);
    }
  std::size_t trees = 0;
  for (const auto& member : blend.members())
    trees += member->ensembles(0).size();
  EXPECT_EQ(blend.ensembles(0).size(), trees);
}

}  // namespace
}  // namespace conchoid
