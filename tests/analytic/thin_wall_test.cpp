#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/wall_resolution.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// Cantilevers of many thicknesses: what linear elements show of the bending stress, and what is said about it.
namespace conchoid {
namespace {

constexpr double kLength = 1, kWidth = 0.3, kForce = 100;

std::string cantilever_text(const std::string& file, const std::string& body_keys,
                            const std::string& elements = "linear") {
  return test::mesh_body_text(file) + body_keys + test::material_text({.E = 7e10, .nu = 0.22}) +
         test::region_text("held", test::half_space_text({-1, 0, 0}, kLength / 2 - 1e-4)) +
         test::region_text("end", test::half_space_text({1, 0, 0}, kLength / 2 - 1e-4)) +
         "[[boundary]]\nregion = 'held'\nfixed = true\n" +
         test::boundary_text("end", "force", {0, 0, -kForce}) + "[run]\nelements = '" + elements + "'\n";
}

TriMesh plate(double thickness) {
  return box_mesh({kLength, kWidth, thickness}, 20, 6,
                  std::max(1, static_cast<int>(std::lround(thickness / 0.05))));
}

/// σ1 on the stretched side over that of beam theory, between two places.
double shown(const StressReport& report, double thickness, double from, double to) {
  double sum = 0, theory = 0;
  for (const auto& t : report.triangles) {
    const Vec3& c = t.centroid;
    if (std::abs(c.z() - thickness / 2) > 1e-3 * thickness || c.x() < from || c.x() > to ||
        std::abs(c.y()) > 0.3 * kWidth)
      continue;
    sum += t.principal[0];
    theory += kForce * (kLength / 2 - c.x()) / (kWidth * thickness * thickness / 6);
  }
  return sum / theory;
}

struct Cantilever {
  double thickness, shown;
};

class ThinWall : public testing::TestWithParam<Cantilever> {};

TEST_P(ThinWall, IsWarnedOfWhereMoreThanATenthIsMissingAndTheShareIsSaid) {
  const test::TemporaryFolder folder;
  const double t = GetParam().thickness;
  const TriMesh mesh = plate(t);
  const StressReport report = compute_stress(
      test::scene_from_text(cantilever_text(test::write_mesh_in(folder, "plate.obj", mesh), "")));
  const double found = shown(report, t, -0.25, 0.25);
  EXPECT_NEAR(found, GetParam().shown, 0.01);
  EXPECT_EQ(report.warnings.size(), found < 0.9 ? 1u : 0u);
  const auto walls = coarse_walls(mesh);
  ASSERT_EQ(walls.has_value(), found < 0.9);
  if (walls) {
    EXPECT_NEAR(walls->shown, found, 0.04);
  }
}

INSTANTIATE_TEST_SUITE_P(Cantilever, ThinWall,
                         testing::Values(Cantilever{0.1, 0.98}, Cantilever{0.05, 0.905},
                                         Cantilever{0.02, 0.60}, Cantilever{0.01, 0.28},
                                         Cantilever{0.006, 0.135}));

TEST(ThinWall, AdvisedElementsShowNineTenths) {
  const test::TemporaryFolder folder;
  const double t = 0.03;
  const auto walls = coarse_walls(plate(t));
  ASSERT_TRUE(walls && walls->affordable());
  EXPECT_NE(walls->text().find(fmt::format("body.remesh = {}", walls->wanted_triangles)), std::string::npos);
  const StressReport report = compute_stress(
      test::scene_from_text(cantilever_text(test::write_mesh_in(folder, "plate.obj", plate(t)),
                                            fmt::format("remesh = {}\n", walls->wanted_triangles))));
  EXPECT_TRUE(report.warnings.empty());
  const double found = shown(report, t, -0.25, 0.25);
  RecordProperty("shown", test::text(found));
  EXPECT_NEAR(found, 1, 0.1);
}

TEST_P(ThinWall, IsShownByQuadraticElementsWhichAreChosenByThemselves) {
  const test::TemporaryFolder folder;
  const double t = GetParam().thickness;
  const StressReport report = compute_stress(
      test::scene_from_text(cantilever_text(test::write_mesh_in(folder, "plate.obj", plate(t)), "", "auto")));
  EXPECT_EQ(report.elements, GetParam().shown < 0.9 ? "quadratic" : "linear");
  EXPECT_NEAR(shown(report, t, -0.25, 0.25), 1, report.elements == "quadratic" ? 0.02 : 0.1);
  EXPECT_TRUE(report.warnings.empty());
}

/// A window: soft supports of single components along the edges, pressure on one side; one element lies over ten
/// thicknesses.
TEST(ThinWall, PaneFollowsPlateTheory) {
  const test::TemporaryFolder folder;
  const double a = 1, t = 0.006, pressure = 1e3, nu = 0.22, E = 7e10;
  std::string text =
      test::mesh_body_text(test::write_mesh_in(folder, "pane.obj", box_mesh({a, a, t}, 16, 16, 1)));
  text += test::material_text({.E = E, .nu = nu});
  int side = 0;
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    const std::string name = "side" + std::to_string(side++);
    text += test::region_text(name, test::half_space_text(n, a / 2 - 1e-4)) + "[[boundary]]\nregion = '" +
            name + "'\ndisplacement = ['free', 'free', 0.0]\n";
  }
  text += test::region_text("top", test::half_space_text({0, 0, 1}, t / 2 - 1e-4)) +
          fmt::format("[[boundary]]\nregion = 'top'\npressure = {}\n", pressure);
  const StressReport report = compute_stress(test::scene_from_text(text));
  EXPECT_EQ(report.elements, "quadratic");
  double stress = 0, count = 0;
  for (const auto& tr : report.triangles)
    if (tr.centroid.z() < -t / 2 + 1e-6 && std::abs(tr.centroid.x()) < a / 8 &&
        std::abs(tr.centroid.y()) < a / 8) {
      stress += tr.principal[0];
      ++count;
    }
  // Timoshenko & Woinowsky-Krieger: w = 0.00406 p a⁴/D, M = 0.0479 p a² at ν = 0.3, of which (1 + ν) / 1.3 here; both sides
  // of the middle within a fourth of the width are 5 % below it.
  const double rigidity = E * t * t * t / (12 * (1 - nu * nu));
  const double bending = 6 * 0.0479 * (1 + nu) / 1.3 * pressure * a * a / (t * t);
  RecordProperty("deflection",
                 test::text(report.max_displacement / (0.00406 * pressure * a * a * a * a / rigidity)));
  RecordProperty("stress", test::text(stress / count / bending));
  EXPECT_NEAR(report.max_displacement / (0.00406 * pressure * a * a * a * a / rigidity), 1, 0.05);
  EXPECT_NEAR(stress / count / bending, 0.97, 0.06);
}

/// Of a determinate body, that is enough: the loads alone say what is carried there.
TEST(ThinWall, ShortEdgesWhereItBreaksShowNineTenthsThere) {
  const test::TemporaryFolder folder;
  const double t = 0.01;
  const auto walls = coarse_walls(plate(t));
  ASSERT_TRUE(walls);
  const StressReport report = compute_stress(test::scene_from_text(
      cantilever_text(test::write_mesh_in(folder, "plate.obj", plate(t)), "remesh = 2500\n") +
      fmt::format("[[region]]\nname = 'root'\nbox = [[-0.51, -1, -1], [-0.4, 1, 1]]\nedge = {:.2g}\n",
                  walls->wanted_edge)));
  const double found = shown(report, t, -0.48, -0.42);
  RecordProperty("shown", test::text(found));
  EXPECT_NEAR(found, 1, 0.1);
  EXPECT_EQ(report.warnings.size(), 1u);  // of the rest
}

}  // namespace
}  // namespace conchoid
