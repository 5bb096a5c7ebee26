#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "conchoid/sim/run.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// Two disc cracks in a pulled cube grow towards each other and become one.
namespace conchoid {
namespace {

constexpr double kCrackEdge = 0.08;

struct Second {
  const char* name;
  double y, z;         ///< of its centre; the first one's is (−0.2, 0, 0)
  Vec3 normal;         ///< the first one's is z
  double surface;      ///< spacing of the visible surface
  const char* fields;  ///< of the material
};

void PrintTo(const Second& second, std::ostream* out) {
  *out << second.name;
}

std::string disc_text(const Vec3& center, const Vec3& normal) {
  return "[[crack]]\nkind = 'disc'\ncenter = " + test::text(center) + "\nnormal = " + test::text(normal) +
         "\nradius = 0.12\n";
}

RunResult pulled_cube(const Second& second) {
  const std::string text =
      "[body]\nmodel = 'cube'\n" + test::material_text() + second.fields +
      test::resolution_text(kCrackEdge, second.surface) + disc_text({-0.2, 0, 0}, {0, 0, 1}) +
      disc_text({0.22, second.y, second.z}, second.normal) +
      test::boundary_text("z+", "traction", {0, 0, 1e7}) +
      test::boundary_text("z-", "traction", {0, 0, -1e7}) + "[run]\nmax_cracks = 0\nframes = 20\n";
  return test::run_text(text);
}

class MeetingCracks : public ::testing::TestWithParam<Second> {};

TEST_P(MeetingCracks, CutTheCubeTogether) {
  const RunResult result = pulled_cube(GetParam());
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_LE(result.document.frames, 10);
  ASSERT_EQ(result.fragments.size(), 2u);
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight);
    EXPECT_NEAR(f.volume, 0.5, 0.03);
  }
  // One surface through the cube, no wandering off.
  double height = 0;
  for (const Vec3& x : result.crack.positions)
    height = std::max(height, std::abs(x.z()));
  EXPECT_LT(height, GetParam().z + 0.8 * kCrackEdge);
  EXPECT_LT(surface_area(result.crack), 1.15);
  // They are one at last: all front points of the last frame are on one front.
  for (const FrontRow& row : result.front)
    if (row.frame == result.document.frames) {
      EXPECT_EQ(row.front, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cubes, MeetingCracks,
    ::testing::Values(Second{"coplanar", 0.05, 0, {0, 0, 1}, 0.008, ""},
                      Second{"coplanar_symmetric", 0, 0, {0, 0, 1}, 0.008, ""},
                      Second{"an_eighth_apart", 0, 0.01, {0, 0, 1}, 0.02, ""},
                      Second{"a_quarter_apart", 0.05, 0.02, {0, 0, 1}, 0.008, ""},
                      Second{"three_eighths_apart", 0.05, 0.03, {0, 0, 1}, 0.008, ""},
                      Second{"opposite_normals", 0.05, 0, {0, 0, -1}, 0.008, ""},
                      Second{"tilted", 0.05, 0, {0.3, 0, 1}, 0.008, ""},
                      Second{
                          "in_noise",
                          0.05,
                          0.03,
                          {0, 0, 1},
                          0.016,
                          "[material.toughness_field]\nkind = 'noise'\nwavelength = 0.2\namplitude = 0.2\n"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace conchoid
