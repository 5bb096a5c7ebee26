#include "conchoid/sim/nearly_through.hpp"

#include <gtest/gtest.h>

#include "conchoid/crack/length_factors.hpp"
#include "conchoid/sim/fracture.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

// A crack from one side of a pulled cube: for long there is more ahead of it than a ligament.
TEST(NearlyThrough, OnlyShortlyBeforeThePulledCubeParts) {
  const Scene scene = test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 9e7}) +
      test::boundary_text("z-", "traction", {0, 0, -9e7}) + "[run]\ninertia_relief = true\n");
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  std::vector<bool> nearly;
  while (!fracture.stop() && fracture.frame() < 30) {
    fracture.step();
    nearly.push_back(nearly_through(fracture.crack(), ClosestPointTree(body->surface), 3 * body->crack_edge));
  }
  ASSERT_EQ(fracture.stop(), StopReason::separated);
  ASSERT_GT(nearly.size(), 5u);
  for (std::size_t i = 0; i + 4 < nearly.size(); ++i)
    EXPECT_FALSE(nearly[i]) << "after step " << i;
  EXPECT_TRUE(nearly.back() || nearly[nearly.size() - 2]);
  EXPECT_FALSE(nearly_through(fracture.crack(), ClosestPointTree(TriMesh{}), 3 * body->crack_edge))
      << "the infinite body";
}

}  // namespace
}  // namespace conchoid
