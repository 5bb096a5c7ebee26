#include "conchoid/core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace conchoid;

TEST(Random, SameSeedSameNumbersOnEveryMachine) {
  // The reference values of splitmix64 (Vigna) and of the standard's mt19937_64 (its 10000th number).
  EXPECT_EQ(mix_bits(0), 0xe220a8397b1dcdafu);
  std::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042u);
  Random a(7), b(7);
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(a.bits(), b.bits());
}

TEST(Random, StreamsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed : {1, 2, 3})
    for (std::uint64_t stream = 0; stream < 100; ++stream)
      first.insert(Random(seed, stream).bits());
  EXPECT_EQ(first.size(), 300u);
}

TEST(Random, IndexIsUniform) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i)
    ++counts[random.index(7)];
  for (int c : counts)
    EXPECT_NEAR(c, 10000, 500);  // five standard deviations
}

TEST(Random, NormalHasZeroMeanAndUnitVariance) {
  Random random(5);
  double sum = 0, squares = 0, fourth = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.012);
  EXPECT_NEAR(squares / kCount, 1, 0.017);
  EXPECT_NEAR(fourth / kCount, 3, 0.12);
}

TEST(Random, UnitVectorsCoverTheSphereEvenly) {
  Random random(9);
  Vec3 mean = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  constexpr int kCount = 50000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 v = random.unit_vector();
    ASSERT_NEAR(v.norm(), 1, 1e-14);
    mean += v / kCount;
    second += v * v.transpose() / kCount;
  }
  EXPECT_LT(mean.norm(), 0.015);
  EXPECT_LT((second - Mat3::Identity() / 3).norm(), 0.01);
}
