#include "conchoid/crack/intensity/front_resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace conchoid {
namespace {

const ElasticConstants m{3.1e9, 0.3};

std::vector<FrontResolution> resolve(const std::vector<Vec3>& K, bool closed = false, double K_c = 1) {
  return resolve_along_front(K, std::vector<double>(K.size(), K_c), closed, m);
}

}  // namespace

// An elliptical front in mixed mode: K varies threefold along it, but little from node to node.
TEST(FrontResolution, SmoothFrontKeepsItsBits) {
  std::vector<Vec3> K;
  for (int i = 0; i < 16; ++i) {
    const double t = 2 * std::numbers::pi * i / 16;
    K.push_back({4 + 2 * std::cos(t), std::sin(t), 0.7 * std::cos(t)});
  }
  const auto resolved = resolve(K, true);
  for (std::size_t i = 0; i < K.size(); ++i) {
    EXPECT_EQ(resolved[i].intensity, K[i]);
    EXPECT_EQ(resolved[i].step, 1);
  }
  EXPECT_TRUE(std::isinf(resolved[0].limit(0.1)));
}

// Changes of sign below K_c move nothing and are none.
TEST(FrontResolution, BelowToughnessNothingIsUnresolved) {
  const auto resolved = resolve({{0.2, 0.1, 0}, {0.1, -0.2, 0}, {0.2, 0.1, 0}});
  EXPECT_EQ(resolved[1].intensity, Vec3(0.1, -0.2, 0));
  EXPECT_EQ(resolved[1].step, 1);
}

TEST(FrontResolution, KThatTurnsFromNodeToNodeIsSmoothed) {
  const std::vector<Vec3> K{{6, 8, 0}, {6, -8, 0}, {6, 8, 0}, {6, -8, 0}, {6, 8, 0}, {6, -8, 0}};
  const auto resolved = resolve(K, true);
  for (const FrontResolution& at : resolved) {
    EXPECT_NEAR(at.intensity[0], 6, 1e-12);  // what the nodes agree on stays
    EXPECT_LT(std::abs(at.intensity[1]), 1);
    EXPECT_EQ(at.step, 1);  // and is resolved
  }
}

// A jump that smoothing does not explain: on as far as it can be believed.
TEST(FrontResolution, ReversedKShortensTheStep) {
  const auto resolved = resolve({{2, 9, 0}, {2, 9, 0}, {2, 9, 0}, {2, -9, 0}, {2, -9, 0}, {2, -9, 0}});
  EXPECT_EQ(resolved[0].step, 1);
  EXPECT_LT(resolved[2].step, 1);
  EXPECT_GE(resolved[2].step, 0.25);
  EXPECT_NEAR(resolved[2].step, resolved[3].step, 1e-12);
  EXPECT_NEAR(resolved[2].limit(0.1), 0.1 * resolved[2].step, 1e-15);
}

// The elements' error in the largest K is more than a K of a hundredth of it, which tells no direction.
TEST(FrontResolution, KFarBelowTheLargestTurnsNothing) {
  const auto resolved = resolve({{100, 0, 0}, {50, 1, 0}, {20, 1, 0}, {5, 1, 0}, {1, 1, 0}}, false, 0.1);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(resolved[i].turn, 1);
  EXPECT_NEAR(resolved[4].turn, std::pow(resolved[4].intensity.norm() / 5, 2), 1e-12);
  EXPECT_LT(resolved[4].turn, 0.5);
}

// Reversed against both neighbours: what smoothing leaves is far less than what it took away.
TEST(FrontResolution, NoiseTurnsNothing) {
  const auto resolved = resolve({{48, 2, 0}, {48, 2, 0}, {-23, -9, 0}, {48, 2, 0}, {48, 2, 0}});
  EXPECT_LT(resolved[2].turn, 0.2);
  EXPECT_EQ(resolved[0].turn, 1);
}

TEST(FrontResolution, PressureHoldsUnlessSlidingKinksOutOfIt) {
  EXPECT_TRUE(resolve({{-3, 0, 0}})[0].pressed);
  EXPECT_TRUE(
      resolve({{-3, 1.5, 0}})[0].pressed);  // K_eff = 1.5 K_c, but pressed together in every direction
  EXPECT_TRUE(resolve({{-30, 20, 5}})[0].pressed);  // K_c would be reached, but closed faces have no such K_I
  EXPECT_FALSE(resolve({{-0.5, 6.6, 0}})[0].pressed);  // a closed notch under shear: its wings open
  EXPECT_FALSE(resolve({{3, 1.5, 0}})[0].pressed);
}

TEST(FrontResolution, GreatestHoopIntensity) {
  EXPECT_NEAR(greatest_hoop_intensity({2, 0, 0}, m), 2, 1e-12);
  EXPECT_NEAR(greatest_hoop_intensity({0, 1, 0}, m), 2 / std::sqrt(3.0), 1e-12);  // at 70.5°
  EXPECT_NEAR(greatest_hoop_intensity({0, -1, 0}, m), 2 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(greatest_hoop_intensity({-1, 0, 0}, m), 0);
}

}  // namespace conchoid
