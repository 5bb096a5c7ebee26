#include "conchoid/elastic/kelvin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};
const Vec3 kSource(0.3, -0.2, 0.5), kPoint(-0.1, 0.4, 0.15);

Mat3 hooke(const Mat3& gradient) {
  const double mu = kGlassy.shear_modulus();
  const double lambda = 2 * mu * kGlassy.poisson_ratio / (1 - 2 * kGlassy.poisson_ratio);
  return lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
}

// Gradient ∂f_i/∂x_j at `at` by central differences, exact to fourth order.
template <class Field>
Mat3 gradient(const Field& field, const Vec3& at) {
  const double h = 1e-3;
  Mat3 g;
  for (int j = 0; j < 3; ++j) {
    const Vec3 e = h * Vec3::Unit(j);
    g.col(j) = (8 * (field(at + e) - field(at - e)) - (field(at + 2 * e) - field(at - 2 * e))) / (12 * h);
  }
  return g;
}

}  // namespace

TEST(Kelvin, StressFollowsFromTheDisplacement) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 force = Vec3::Unit(k);
    const Mat3 exact = hooke(gradient(
        [&](const Vec3& x) -> Vec3 { return kelvin_displacement(x - kSource, kGlassy) * force; }, kPoint));
    EXPECT_LT((kelvin_stress(kSource - kPoint, force, kGlassy) - exact).norm(), 1e-8 * exact.norm());
  }
}

// The displacement that a dislocation w across n at y causes at x is, by reciprocity, w · σ(y) n of the
// stress that a unit force at x causes at y; Hooke's law on its gradient gives the stress, with the sign of
// the representation formula u(x) = ∫ U t − ∫ T w.
TEST(Kelvin, DislocationStressFollowsFromTheForceStress) {
  const Vec3 n = Vec3(1, 2, -2) / 3, w(0.2, -0.5, 0.7);
  const auto displacement = [&](const Vec3& x) -> Vec3 {
    Vec3 u;
    for (int i = 0; i < 3; ++i)
      u[i] = w.dot(kelvin_stress(x - kSource, Vec3::Unit(i), kGlassy) * n);
    return u;
  };
  const Mat3 exact = hooke(gradient(displacement, kPoint));
  EXPECT_LT((kelvin_dislocation_stress(kSource - kPoint, n, w, kGlassy) - exact).norm(), 1e-8 * exact.norm());
}

// The tractions on a sphere around a force hold it: ∫ σ n = −f.
TEST(Kelvin, ForceIsHeldByTheStressAroundIt) {
  const Vec3 force(1, -2, 0.5);
  Vec3 sum = Vec3::Zero();
  const int n = 200;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double theta = std::numbers::pi * (i + 0.5) / n, phi = std::numbers::pi * (j + 0.5) / n;
      const Vec3 e(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      sum += std::sin(theta) * std::numbers::pi * std::numbers::pi / n / n *
             (kelvin_stress(-e, force, kGlassy) * e);
    }
  EXPECT_LT((sum + force).norm(), 1e-3);
}

}  // namespace conchoid
