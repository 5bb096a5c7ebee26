#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// Cracks under loads that quadratic elements computed (docs/theory.md 2.4).
namespace conchoid {
namespace {

std::string column_text(const std::string& elements) {
  return "[body]\nmodel = 'edge-crack-cube'\n" + test::material_text({.E = 7e10, .nu = 0.22}) +
         test::boundary_text("z-", "displacement", {0, 0, 0}) +
         test::boundary_text("z+", "traction", {1e5, 0, 1e6}) + "[run]\nelements = '" + elements + "'\n";
}

/// Stout, and sheared: both orders show the same stress but for their errors, and so the same K.
TEST(Elements, SuperpositionOpensACrackAsTheLoadItselfDoes) {
  const SifReport linear = compute_sifs(test::scene_from_text(column_text("linear")));
  const SifReport quadratic = compute_sifs(test::scene_from_text(column_text("quadratic")));
  EXPECT_EQ(linear.elements, "linear");
  EXPECT_EQ(quadratic.elements, "quadratic");
  double largest = 0, difference = 0;
  for (std::size_t f = 0; f < linear.fronts.size(); ++f)
    for (std::size_t i = 0; i < linear.fronts[f].nodes.size(); ++i) {
      const Vec3& K = linear.fronts[f].nodes[i].intensity;
      largest = std::max(largest, K.norm());
      difference = std::max(difference, (quadratic.fronts[f].nodes[i].intensity - K).norm());
    }
  RecordProperty("difference", test::text(difference / largest));
  EXPECT_GT(largest, 0);
  EXPECT_LT(difference, 0.05 * largest);
  EXPECT_NEAR(quadratic.opened_volume / linear.opened_volume, 1, 0.03);
}

}  // namespace
}  // namespace conchoid
