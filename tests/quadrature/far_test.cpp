#include <random>

#include "conchoid/quadrature/far_rules.hpp"
#include "expect_accurate.hpp"

namespace conchoid {
namespace {

TEST(Far, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(oracle::far_pairs());
}

TEST(Far, LimitsSayTheSameDegrees) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.01, 1.1);
  for (const double tolerance : {5e-4, 5e-5, 5e-7, 5e-12}) {
    const FarLimits limits(tolerance);
    for (int i = 0; i < 2000; ++i)
      for (const Layer layer : {Layer::single, Layer::dbl}) {
        const double radius = share(random), distance = share(random);
        ASSERT_EQ(limits.degree(layer, radius, distance), far_degree(layer, radius, distance, tolerance))
            << radius << " of " << distance << " to " << tolerance;
      }
  }
}

}  // namespace
}  // namespace conchoid
