#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "conchoid/sim/run.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// Cracks that grow towards a load that presses: bars in bending, a disc split between two pads.
namespace conchoid {
namespace {

std::string bar_text() {
  return "[body]\nmodel = 'bar'\n" + test::material_text() + test::resolution_text(0.008, 0.002);
}

// A disc of radius 50 mm and 20 mm thick about the z axis, elements of its rim 1/36 of the circle.
TriMesh disc_body() {
  constexpr int around = 36, rings = 5, levels = 3;
  constexpr double radius = 0.05, thickness = 0.02;
  TriMesh mesh;
  const auto at = [&](double r, int j, double z) {
    const double angle = 2 * std::numbers::pi * (j % around) / around;
    return mesh.positions.add({r * std::cos(angle), r * std::sin(angle), z});
  };
  std::vector<std::vector<NodeId>> side;  // per level, the rim
  for (int level = 0; level <= levels; ++level) {
    side.emplace_back();
    for (int j = 0; j < around; ++j)
      side.back().push_back(at(radius, j, thickness * level / levels));
  }
  const auto quad = [&](NodeId a, NodeId b, NodeId c, NodeId d) {
    mesh.corners.push_back({a, b, c});
    mesh.corners.push_back({a, c, d});
  };
  for (int level = 0; level < levels; ++level)
    for (int j = 0; j < around; ++j) {
      const int k = (j + 1) % around;
      quad(side[level][j], side[level][k], side[level + 1][k], side[level + 1][j]);
    }
  for (const bool top : {false, true}) {
    std::vector<NodeId> outer = top ? side.back() : side.front();
    const double z = top ? thickness : 0;
    for (int ring = rings - 1; ring > 0; --ring) {
      std::vector<NodeId> inner;
      for (int j = 0; j < around; ++j)
        inner.push_back(at(radius * ring / rings, j, z));
      for (int j = 0; j < around; ++j) {
        const int k = (j + 1) % around;
        top ? quad(inner[j], outer[j], outer[k], inner[k]) : quad(outer[k], outer[j], inner[j], inner[k]);
      }
      outer = inner;
    }
    const NodeId center = mesh.positions.add({0, 0, z});
    for (int j = 0; j < around; ++j) {
      const int k = (j + 1) % around;
      mesh.corners.push_back(top ? std::array{outer[j], outer[k], center}
                                 : std::array{outer[k], outer[j], center});
    }
  }
  return mesh;
}

// Pressed between pads of 30°, with a slit of 24 mm through its middle, `tilt` from the line of the load.
std::string disc_text(const std::string& mesh, double tilt) {
  const double pad = 0.05 * std::cos(std::numbers::pi / 12) - 1e-6;
  const std::string side = ", [0, 0, 1, -1e-6], [0, 0, -1, -0.019999]";
  const Vec3 along = 0.024 * Vec3(std::sin(tilt), std::cos(tilt), 0);
  return test::mesh_body_text(mesh) + test::material_text({30e9, 0.25, 5e6, 1e6}) +
         test::resolution_text(0.006, 0.0015) +
         test::region_text("top", test::half_space_text({0, 1, 0}, pad) + side) +
         test::region_text("bottom", test::half_space_text({0, -1, 0}, pad) + side) +
         test::boundary_text("top", "force", {0, -2e4, 0}) +
         test::boundary_text("bottom", "force", {0, 2e4, 0}) +
         "[[crack]]\nkind = 'rectangle'\ncenter = [0.0003, 0.0, 0.01]\nedges = [" + test::text(along) +
         ", [0.0, 0.0, 0.03]]\n[run]\nmax_cracks = 0\n";
}

}  // namespace

TEST(NotchedBar, ThreePointBendingPartsItFromTheNotchToTheLoad) {
  const RunResult result =
      test::run_text(bar_text() + test::boundary_text("support-left", "force", {0, 0, 5e4}) +
                     test::boundary_text("support-right", "force", {0, 0, 5e4}) +
                     test::boundary_text("load", "force", {0, 0, -1e5}) + "[run]\nframes = 20\n");
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_TRUE(result.document.warnings.empty());
  ASSERT_EQ(result.fragments.size(), 2u);
  EXPECT_GT(result.fragments[1].volume, 0.9 * result.fragments[0].volume);
  EXPECT_LT(surface_area(result.crack), 1.5 * 0.04 * 0.04);  // width × height above the notch
  for (const FrontRow& row : result.front)
    EXPECT_LT(std::abs(row.position.x()), 0.0125);  // half the load's width
}

class PressedDisc : public ::testing::TestWithParam<int> {};

TEST_P(PressedDisc, SplitsAlongTheLoad) {
  const test::TemporaryFolder folder;
  const RunResult result = test::run_text(
      disc_text(test::write_mesh_in(folder, "disc.obj", disc_body()), GetParam() * std::numbers::pi / 180));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_EQ(result.fragments.size(), 2u);
  EXPECT_GT(result.fragments[1].volume, 0.9 * result.fragments[0].volume);
  EXPECT_LT(surface_area(result.crack), 1.3 * 0.1 * 0.02);  // diameter × thickness
  for (const FrontRow& row : result.front) {
    const bool on_slit = std::abs(row.position.y()) < 0.013;
    EXPECT_TRUE(on_slit || std::abs(row.position.x()) < 0.008) << row.position.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Tilt, PressedDisc, ::testing::Values(0, 30));

}  // namespace conchoid
