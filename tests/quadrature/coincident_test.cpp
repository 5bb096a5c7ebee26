#include <gtest/gtest.h>

#include "oracle.hpp"

namespace conchoid {
namespace {

using oracle::panel;

TEST(Coincident, EquilateralTriangleOfSideOne) {
  // Eibert & Hansen: −(4A²/3) Σ ln(1 − side/half perimeter) / side = 4A² ln 3, A = √3/4.
  const Panel x = panel({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(3) / 2, 0)}, 0, 1, 2);
  EXPECT_NEAR(PairIntegrator().single_layer(x, x).laplace, 0.75 * std::log(3.0), 1e-15);
}

TEST(Coincident, UnitSquareOfTwoTriangles) {
  // ∫∫ 1/R over a unit square = 4/3 · (1 − √2 + 3 ln(1 + √2)).
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  const Panel x = panel({a, b, c}, 0, 1, 2), y = panel({a, c, d}, 0, 2, 3);
  const PairIntegrator integrator(1e-11);
  const double sum = integrator.single_layer(x, x).laplace + integrator.single_layer(y, y).laplace +
                     2 * integrator.single_layer(x, y).laplace;
  EXPECT_NEAR(sum, 4.0 / 3 * (1 - std::sqrt(2.0) + 3 * std::log(1 + std::sqrt(2.0))), 1e-14);
}

TEST(Coincident, MatchesTheSlowIntegralHoweverThin) {
  for (double height : {1.0, 0.1, 0.01, 1e-3}) {
    const Panel x = panel({Vec3(0.2, 0, 0.1), Vec3(1, 0.3, 0), Vec3(0.7, height, 0.2 * height)}, 0, 1, 2);
    const Family exact = oracle::single_layer(x, x, 1e-12);
    EXPECT_LT(oracle::relative_error(oracle::family(PairIntegrator().single_layer(x, x)), exact), 1e-11)
        << height;
  }
}

TEST(Coincident, TheTwoFacesOfACrackAreOnePanelAndHaveNoDoubleLayer) {
  const Triangle t = {Vec3(0.2, 0, 0.1), Vec3(1, 0.3, 0), Vec3(0.7, 0.8, 0.2)};
  const Panel front = panel(t, 4, 5, 6), back = panel({t[1], t[0], t[2]}, 5, 4, 6);
  const PairIntegrator integrator;
  EXPECT_NEAR(integrator.single_layer(front, back).laplace, integrator.single_layer(front, front).laplace,
              1e-15);
  EXPECT_EQ(integrator.double_layer(front, back), DoubleLayerPair{});
}

}  // namespace
}  // namespace conchoid
