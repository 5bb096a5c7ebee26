#include <gtest/gtest.h>

#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

// As at a corner, where what is inside of the body has no front of its own left.
TEST(BemOpening, APointThatNoFrontGoesThroughHasNoIntensity) {
  const ElasticConstants glassy{3.1e9, 0.327};
  const AmbientField pull =
      uniform_stress(1e6 * Mat3::Identity(), glassy.youngs_modulus, glassy.poisson_ratio);
  CrackState crack;
  append_part(crack.sheet, disc_crack(Vec3::Zero(), Vec3::UnitZ(), 0.5, {.triangles = 54}));
  update_crack(crack, {}, 0.2);
  crack.fronts.clear();
  for (FrontPoint& point : crack.points)
    point.correlation = NodeId{};
  BemOpening bem(make_body_operator({}, {}, glassy), {{}, {}, pull}, {});
  const std::vector<FrontOpening> openings = bem.open(crack);
  ASSERT_FALSE(openings.empty());
  for (const FrontOpening& o : openings) {
    EXPECT_EQ(o.intensity, Vec3::Zero());
    EXPECT_EQ(o.node_intensity, Vec3::Zero());
  }
}

}  // namespace conchoid
