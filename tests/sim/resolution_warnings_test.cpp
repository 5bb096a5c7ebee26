#include "conchoid/sim/resolution_warnings.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/reports.hpp"
#include "conchoid/sim/run.hpp"
#include "hollow_bodies.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

std::vector<std::string> said(const std::string& scene) {
  return resolution_warnings(prepare(test::scene_from_text(scene)), {}, true);
}

std::string pulled_text(const test::TemporaryFolder& folder, const TriMesh& body, double crack) {
  const double top = bounding_box(body).high.z();
  return test::mesh_body_text(test::write_mesh_in(folder, "body.obj", body)) +
         test::material_text({.nu = 0}) + test::resolution_text(crack, crack / 20) +
         test::region_text("low", test::half_space_text({0, 0, -1}, top - 1e-6)) +
         test::region_text("high", test::half_space_text({0, 0, 1}, top - 1e-6)) +
         test::boundary_text("low", "traction", {0, 0, -1e6}) +
         test::boundary_text("high", "traction", {0, 0, 1e6}) + "[run]\ninertia_relief = true\n";
}

TEST(ResolutionWarnings, StoutScenesHaveNone) {
  EXPECT_TRUE(said(test::pulled_cube_text()).empty());
  EXPECT_TRUE(said(test::cracked_cube_text("", 0.1, 0.02)).empty());
  EXPECT_TRUE(compute_sifs(test::scene_from_text(test::cracked_cube_text("", 0.1, 0.02))).warnings.empty());
}

TEST(ResolutionWarnings, ACrackEdgeIsComparedWithTheWall) {
  const test::TemporaryFolder folder;
  const TriMesh plate = box_mesh({1, 0.1, 1}, 10, 2, 10);
  const auto warnings = said(pulled_text(folder, plate, 0.08));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("on a wall of 0.1 m"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("use 0.05 or less"), std::string::npos) << warnings[0];
  EXPECT_TRUE(said(pulled_text(folder, plate, 0.05)).empty());
}

TEST(ResolutionWarnings, ACrackEdgeIsComparedWithAHole) {
  const test::TemporaryFolder folder;
  const TriMesh tube = shapes::tube(0.6, 0.1, 1, 6, 24);
  const auto warnings = said(pulled_text(folder, tube, 0.1));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("hole of radius 0.099 m around (0, 0, 0)"), std::string::npos) << warnings[0];
  EXPECT_TRUE(said(pulled_text(folder, tube, 0.05)).empty());
}

TEST(ResolutionWarnings, WallsThatQuadraticElementsShowHaveNone) {
  const test::TemporaryFolder folder;
  const std::string text = pulled_text(folder, box_mesh({1, 0.05, 1}, 4, 1, 4), 0.025);
  EXPECT_TRUE(said(text).empty());
  const auto linear = said(text + "elements = 'linear'\n");
  ASSERT_EQ(linear.size(), 1u);
  EXPECT_NE(linear[0].find("run.elements = \"auto\""), std::string::npos) << linear[0];
}

TEST(ResolutionWarnings, ARunReportsThem) {
  const test::TemporaryFolder folder;
  Scene scene = test::scene_from_text(pulled_text(folder, box_mesh({1, 0.02, 1}, 4, 1, 4), 0.01));
  scene.run.frames = 1;
  const RunResult result = run_scene(scene, {});
  ASSERT_EQ(result.document.warnings.size(), 1u);
  EXPECT_NE(result.document.warnings[0].find("quadratic elements"), std::string::npos);
}

/// Of an edge crack across a coarse cube, K over a strip's of the same depth.
std::pair<double, std::vector<std::string>> edge_crack(int rows, int across) {
  constexpr double depth = 0.06;
  const test::TemporaryFolder folder;
  TriMesh sheet;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= across; ++j)
      sheet.positions.push_back({-0.5 + depth * i / rows, -0.5 + 1.0 * j / across, 0});
  const auto node = [&](int i, int j) { return NodeId(i * (across + 1) + j); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < across; ++j) {
      sheet.corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      sheet.corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  const SifReport report = compute_sifs(
      test::scene_from_text(pulled_text(folder, box_mesh({1, 1, 2}, 2, 2, 4), depth / rows) +
                            test::mesh_crack_text(test::write_mesh_in(folder, "crack.obj", sheet))));
  double sum = 0, count = 0;
  for (const auto& front : report.fronts)
    for (const SifNode& n : front.nodes)
      if (std::abs(n.position.y()) < 0.2) {
        sum += n.intensity[0];
        ++count;
      }
  const double exact = 1e6 * std::sqrt(std::numbers::pi * depth) * 1.145;  // Tada, depth 0.06 of the width
  return {sum / count / exact, report.warnings};
}

TEST(ResolutionWarnings, ACrackOfOneRowIsWarnedOfAndOneOfTwoIsFair) {
  const auto [one, of_one] = edge_crack(1, 16);
  EXPECT_NEAR(one, 1, 0.1);
  ASSERT_EQ(of_one.size(), 1u);
  EXPECT_NE(of_one[0].find("m deep, hardly more than one of its edges"), std::string::npos) << of_one[0];
  EXPECT_NE(of_one[0].find("resolution.crack = 0.02"), std::string::npos) << of_one[0];
  const auto [two, of_two] = edge_crack(2, 30);
  EXPECT_NEAR(two, 1, 0.15);
  EXPECT_TRUE(of_two.empty());
  RecordProperty("one", test::text(one));
  RecordProperty("two", test::text(two));
}

// A round column, of which a square prism leaves out a third and one of eight sides hardly anything.
TEST(ResolutionWarnings, ElementsThatAreSlimmerThanTheBodyAreSaid) {
  const test::TemporaryFolder folder;
  const auto warning = [&](int sides) {
    PreparedBody body = prepare(test::scene_from_text(
        test::mesh_body_text(test::write_mesh_in(folder, "column.obj", shapes::column(sides))) +
        test::material_text() + test::resolution_text(0.05, 0.01)));
    EXPECT_FALSE(outline_warning(body, {0.2, 0, 0}));
    body.detailed = shapes::column(48);
    return outline_warning(body, {0.15, 0.15, 0.03});
  };
  const auto coarse = warning(4);
  ASSERT_TRUE(coarse);
  EXPECT_NE(coarse->find("where the body is 0.38 m thick and its boundary elements are 0.28 m"),
            std::string::npos)
      << *coarse;
  EXPECT_FALSE(warning(8));
}

TEST(ResolutionWarnings, AnEdgeOfARegionGoesWithRemesh) {
  const std::string text =
      test::pulled_cube_text() + "[[region]]\nname = 'fine'\nbox = [[0, 0, 0], [1, 1, 1]]\nedge = 0.05\n";
  EXPECT_NE(test::refusal([&] { test::scene_from_text(text); }).find("body.remesh"), std::string::npos);
}

}  // namespace
}  // namespace conchoid
