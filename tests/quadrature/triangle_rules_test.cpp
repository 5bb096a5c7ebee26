#include "conchoid/quadrature/triangle_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace conchoid {
namespace {

double factorial(int n) {
  return n <= 1 ? 1.0 : n * factorial(n - 1);
}

TEST(TriangleRules, EveryMonomialUpToTheDegreeIsExact) {
  for (const TriangleRule& rule : triangle_rules()) {
    for (int i = 0; i <= rule.degree; ++i) {
      for (int j = 0; i + j <= rule.degree; ++j) {
        double sum = 0;
        for (const RulePoint& p : rule.points)
          sum += p.weight * std::pow(p.l0, i) * std::pow(p.l1, j);
        const double exact = 2 * factorial(i) * factorial(j) / factorial(i + j + 2);
        EXPECT_NEAR(sum, exact, 1e-15) << "degree " << rule.degree << ", l0^" << i << " l1^" << j;
      }
    }
  }
}

TEST(TriangleRules, TheNextDegreeIsNotExact) {
  for (const TriangleRule& rule : triangle_rules()) {
    double worst = 0;
    const int d = rule.degree + 1;
    for (int i = 0; i <= d; ++i) {
      double sum = 0;
      for (const RulePoint& p : rule.points)
        sum += p.weight * std::pow(p.l0, i) * std::pow(p.l1, d - i);
      const double exact = 2 * factorial(i) * factorial(d - i) / factorial(d + 2);
      worst = std::max(worst, std::abs(sum / exact - 1));
    }
    EXPECT_GT(worst, 1e-6) << "degree " << rule.degree << " promises less than it holds";
  }
}

TEST(TriangleRules, PointsLieInsideWithPositiveWeights) {
  for (const TriangleRule& rule : triangle_rules()) {
    for (const RulePoint& p : rule.points) {
      EXPECT_GT(std::min({p.l0, p.l1, p.l2, p.weight}), 0.0) << "degree " << rule.degree;
      EXPECT_NEAR(p.l0 + p.l1 + p.l2, 1.0, 1e-15);
    }
  }
}

}  // namespace
}  // namespace conchoid
