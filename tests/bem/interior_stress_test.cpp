#include "conchoid/bem/interior_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "arbitrary_rotation.hpp"
#include "conchoid/elastic/kelvin.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};
constexpr int kHalvings = 7;

// Middles of the pieces of a triangle that is halved again and again.
Mat3 by_middles(const Vec3& x, const LoadedPanel& p) {
  const auto& y = p.panel.x;
  const int n = 1 << kHalvings;
  Mat3 sum = Mat3::Zero();
  const auto add = [&](double b1, double b2) {
    const double b0 = 1 - b1 - b2;
    const Vec3 d = b0 * y[0] + b1 * y[1] + b2 * y[2] - x;
    const Vec3 w = b0 * p.density[0] + b1 * p.density[1] + b2 * p.density[2];
    sum += kelvin_stress(d, p.traction, kGlassy) - kelvin_dislocation_stress(d, p.panel.normal, w, kGlassy);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
      if (i + j + 1 < n) add((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
    }
  return sum * p.panel.area / (n * n);
}

}  // namespace

// At any distance from a panel, whichever rule it takes.
TEST(InteriorStress, IsThatOfManyPointsOnThePanel) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Vec3(size * Vec3(normal(random), normal(random), normal(random)));
  };
  for (const double distance : {0.2, 0.5, 1.0, 2.0, 4.0, 8.0, 9.0, 20.0})
    for (int trial = 0; trial < 20; ++trial) {
      const Mat3 turn = test::arbitrary_rotation();
      const Triangle corners{turn * Vec3(0, 0, 0), turn * Vec3(1, 0, 0), turn * Vec3(0.3, 0.6, 0)};
      LoadedPanel p{make_panel(corners, {NodeId(0), NodeId(1), NodeId(2)}), vector(1e6), {}};
      for (Vec3& w : p.density)
        w = vector(1e-3);
      Vec3 away = vector(1).normalized();
      if (std::abs(away.dot(p.panel.normal)) < 0.5) away = p.panel.normal;
      const Vec3 x = p.panel.center + distance * away;
      const Mat3 exact = by_middles(x, p);
      const Mat3 found = interior_stress(std::span(&x, 1), {p}, kGlassy)[0];
      EXPECT_LT((found - exact).norm(), 2e-3 * exact.norm()) << distance;
    }
}

}  // namespace conchoid
