#include "conchoid/crack/law/criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace conchoid;

namespace {
const ElasticConstants kSteel{2.1e11, 0.3};
constexpr double kDegree = std::numbers::pi / 180;

/// Angle of greatest hoop intensity by trying them all.
double best_angle(const Vec3& K) {
  double best = 0;
  for (int i = -1800; i <= 1800; ++i)
    if (hoop_intensity(K, 0.1 * i * kDegree) > hoop_intensity(K, best)) best = 0.1 * i * kDegree;
  return best;
}
}  // namespace

TEST(KinkAngle, PureSlidingTurnsBySeventyAndAHalfDegrees) {
  EXPECT_NEAR(kink_angle({0, 1e6, 0}, kSteel), -std::acos(1.0 / 3), 1e-12);
  EXPECT_NEAR(kink_angle({0, -1e6, 0}, kSteel), std::acos(1.0 / 3), 1e-12);
  EXPECT_NEAR(std::acos(1.0 / 3) / kDegree, 70.53, 0.005);
}

TEST(KinkAngle, IsWhereTheHoopTensionIsGreatest) {
  for (double k1 : {0.0, 0.2, 1.0, 5.0})
    for (double k2 : {-3.0, -1.0, -0.01, 0.5, 2.0})
      EXPECT_NEAR(kink_angle({k1, k2, 0}, kSteel), best_angle({k1, k2, 0}), 0.06 * kDegree)
          << k1 << " " << k2;
}

TEST(KinkAngle, OpeningAndTearingGoStraightOn) {
  EXPECT_EQ(kink_angle({1, 0, 0}, kSteel), 0);
  EXPECT_EQ(kink_angle({1, 0, 7}, kSteel), 0);
  EXPECT_EQ(kink_angle({0, 0, 0}, kSteel), 0);
  EXPECT_EQ(kink_angle({-1, 0, 0}, kSteel), 0);
  EXPECT_NEAR(kink_angle({1e6, 1e-6, 0}, kSteel), -2e-12, 1e-18);
}

TEST(KinkAngle, HasAnInverse) {
  for (double angle = -1.2; angle <= 1.2; angle += 0.1) {
    const auto [opened, slid] = kinking_intensity(angle);
    EXPECT_NEAR(std::hypot(opened, slid), 1, 1e-15);
    EXPECT_NEAR(kink_angle({opened, slid, 0}, kSteel), angle, 1e-12);
  }
  for (const double beyond : {1.3, 3.0}) {
    EXPECT_EQ(kinking_intensity(beyond)[1], -1);
    EXPECT_EQ(kinking_intensity(-beyond)[1], 1);
  }
}

TEST(KinkAngle, TearingDampsTheKink) {
  EXPECT_LT(std::abs(kink_angle({1, 1, 2}, kSteel)), std::abs(kink_angle({1, 1, 0}, kSteel)));
  const double together = std::sqrt(1 + 4 / (1 - 0.3));
  EXPECT_NEAR(kink_angle({1, 1, 2}, kSteel), kink_angle({together, 1, 0}, kSteel), 1e-14);
}

TEST(EffectiveIntensity, AddsTheModesAndIgnoresClosure) {
  EXPECT_NEAR(effective_intensity({3, 4, 0}, kSteel), 5, 1e-14);
  EXPECT_NEAR(effective_intensity({0, 0, 7}, kSteel), 7 / std::sqrt(0.7), 1e-14);
  EXPECT_NEAR(effective_intensity({-100, 4, 0}, kSteel), 4, 1e-14);
  EXPECT_EQ(effective_intensity({-100, 0, 0}, kSteel), 0);
}

TEST(CompressiveFactor, TurnsOnlyDominantCompressionRound) {
  const Vec3 tension(2, 1, 0);
  EXPECT_EQ(with_compressive_factor(tension, 3), tension);
  EXPECT_EQ(with_compressive_factor({-6, 0, 0.5}, 3), Vec3(2, 0, -0.5 / 3));
  const Vec3 sliding(0, 1, 0);  // as tensile on one side as compressive on the other
  EXPECT_EQ(with_compressive_factor(sliding, 1.0001), sliding);
  EXPECT_EQ(with_compressive_factor({-0.1, 1, 0}, 3), Vec3(-0.1, 1, 0));
}

TEST(RayleighSpeed, AgreesWithPublishedRatios) {
  const struct { double nu, ratio; } known[] = {{0.0, 0.8740}, {0.25, 0.9194}, {0.3, 0.9274}, {0.5, 0.9553}};
  for (const auto& [nu, ratio] : known) {
    const ElasticConstants m{2 * (1 + nu), nu};  // μ = 1
    EXPECT_NEAR(rayleigh_speed(m, 1), ratio, 5e-5) << nu;
    const double x = rayleigh_speed(m, 1), eta = (1 - 2 * nu) / (2 - 2 * nu);
    EXPECT_NEAR(std::pow(2 - x * x, 2), 4 * std::sqrt(1 - x * x) * std::sqrt(1 - eta * x * x), 1e-12);
    EXPECT_NEAR(rayleigh_speed(m, 4, RayleighFormula::published), 0.45, 1e-15);
  }
  EXPECT_NEAR(rayleigh_speed({3.1e9, 0.327}, 1200), 920, 5);  // m/s, the polymer of the examples
}

TEST(AdvanceLength, LiesBetweenATenthAndOneResolution) {
  EXPECT_EQ(advance_length(0.999e6, 1e6, 0.1), 0);
  EXPECT_DOUBLE_EQ(advance_length(1e6, 1e6, 0.1), 0.01);
  EXPECT_DOUBLE_EQ(advance_length(2e6, 1e6, 0.1), 0.075);
  EXPECT_NEAR(advance_length(1e12, 1e6, 0.1), 0.1, 1e-12);
  EXPECT_EQ(advance_length(0, 0, 0.1), 0);
}
