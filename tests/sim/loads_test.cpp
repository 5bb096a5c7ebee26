#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/reports.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

// Loads and supports as a scene gives them.
namespace conchoid {
namespace {

constexpr double kStress = 1e6;

std::string condition(const std::string& region, const std::string& keys) {
  return fmt::format("[[boundary]]\nregion = '{}'\n{}\n", region, keys);
}

std::string cube(const std::string& conditions) {
  return "[body]\nmodel = 'cube'\n" + test::material_text() + conditions;
}

const std::string kThreeRollers = condition("x-", "displacement = [0.0, 'free', 'free']") +
                                  condition("y-", "displacement = ['free', 0.0, 'free']") +
                                  condition("z-", "displacement = ['free', 'free', 0.0]");

StressReport stress(const std::string& text) {
  return compute_stress(test::scene_from_text(text));
}

double error_of(const StressReport& report, const Vec3& principal) {
  double error = 0;
  for (const auto& t : report.triangles)
    error = std::max(error, (t.principal - principal).norm() / kStress);
  return error;
}

std::string refusal_of_scene(const std::string& text) {
  return test::refusal([&] { prepare(test::scene_from_text(text)); });
}

}  // namespace

TEST(Components, RollersOnThreePlanesGiveUniformStress) {
  const auto report = stress(cube(kThreeRollers + test::boundary_text("z+", "traction", {0, 0, kStress})));
  EXPECT_LT(error_of(report, {kStress, 0, 0}), 1e-4);
}

TEST(Components, APrescribedComponentGoesWithATractionInTheOthers) {
  const double E = 3.1e9, nu = 0.327, shear = 0.4 * kStress;  // sheared, and pressed in a tight die
  const auto report = stress(cube(
      condition("x-", "displacement = [0.0, 'free', 'free']") +
      condition("x+", "displacement = [0.0, 'free', 'free']") +
      condition("y-", fmt::format("displacement = ['free', 0.0, 'free']\ntraction = [0, 0, {}]", -shear)) +
      condition("y+", fmt::format("displacement = ['free', {}, 'free']\ntraction = [0, 0, {}]",
                                  -kStress * (1 - nu * nu) / E, shear)) +
      condition("z-", fmt::format("traction = [0, {}, 0]", -shear)) +
      condition("z+", fmt::format("traction = [0, {}, 0]", shear))));
  const double middle = -0.5 * kStress, radius = std::hypot(middle, shear);
  Vec3 principal(middle + radius, middle - radius, -nu * kStress);
  std::sort(principal.data(), principal.data() + 3, std::greater<>());
  EXPECT_LT(error_of(report, principal), 1e-4);
}

TEST(Components, AxesTurnThemWithTheBody) {
  const test::TemporaryFolder folder;
  const Mat3 R = test::arbitrary_rotation();
  TriMesh box = box_mesh({1, 0.8, 1.3}, 3, 2, 3);
  const auto scene_of = [&](const Mat3& turn, const std::string& name) {
    TriMesh mesh = box;
    for (Vec3& x : mesh.positions)
      x = turn * x;
    std::string text = test::mesh_body_text(test::write_mesh_in(folder, name, mesh)) + test::material_text();
    const auto side = [&](const std::string& region, const Vec3& n, double d) {
      text += test::region_text(region, test::half_space_text(turn * n, d - 1e-6));
    };
    side("foot", -Vec3::UnitZ(), 0.65);
    side("side", -Vec3::UnitX(), 0.5);
    side("top", Vec3::UnitZ(), 0.65);
    const std::string axes = fmt::format("axes = [{}, {}, {}]\n", test::text(Vec3(turn.col(0))),
                                         test::text(Vec3(turn.col(1))), test::text(Vec3(turn.col(2))));
    return text + condition("foot", axes + "displacement = ['free', 0.0, 0.0]") +
           condition("side", axes + "displacement = [1e-4, 'free', 'free']\ntraction = [0, 2e5, 0]") +
           condition("top", axes + "traction = [3e5, 0, 1e6]");
  };
  const auto straight = stress(scene_of(Mat3::Identity(), "straight.obj"));
  const auto askew = stress(scene_of(R, "askew.obj"));
  ASSERT_EQ(straight.triangles.size(), askew.triangles.size());
  double error = 0, largest = 0;
  for (std::size_t t = 0; t < askew.triangles.size(); ++t) {
    error = std::max(error, (askew.triangles[t].principal - straight.triangles[t].principal).norm());
    largest = std::max(largest, straight.triangles[t].principal.norm());
  }
  EXPECT_LT(error, 1e-5 * largest);
}

TEST(Components, ContradictionsNameTheRegionsAndTheRemedy) {
  const std::string message = refusal_of_scene(cube(condition("z-", "displacement = [0.0, 'free', 1e-3]") +
                                                    condition("x-", "displacement = ['free', 0.0, 2e-3]")));
  for (const char* part :
       {"'x-'", "'z-'", "scene.toml:8", "displace it differently", "leave a component free"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  const std::string alike = refusal_of_scene(cube(
      condition("z-", "displacement = ['free', 'free', 0.0]") +
      condition("x-",
                "axes = [[1, 0, 0.001], [0, 1, 0], [-0.001, 0, 1]]\ndisplacement = ['free', 'free', 0.0]")));
  EXPECT_NE(alike.find("directions that are nearly the same"), std::string::npos) << alike;
}

TEST(Components, AMotionThatIsLeftFreeIsNamed) {
  const std::string pulled = test::boundary_text("x+", "traction", {kStress, 0, 0});
  const std::string slides =
      refusal_of_scene(cube(condition("z-", "displacement = ['free', 'free', 0.0]") + pulled));
  EXPECT_NE(slides.find("a translation along (1 "), std::string::npos) << slides;
  EXPECT_NE(slides.find("inertia_relief"), std::string::npos) << slides;
  const std::string turns = refusal_of_scene(cube(condition("z-", "displacement = ['free', 'free', 0.0]") +
                                                  test::boundary_text("x+", "traction", {0, kStress, 0}) +
                                                  test::boundary_text("x-", "traction", {0, -kStress, 0})));
  EXPECT_NE(turns.find("a rotation about (0 0 1) through (0 0 0)"), std::string::npos) << turns;
  EXPECT_EQ(refusal_of_scene(cube(condition("z-", "displacement = ['free', 'free', 0.0]") + pulled +
                                  test::boundary_text("x-", "traction", {-kStress, 0, 0}))),
            "accepted")
      << "a load in balance needs no more";
}

// Pulled on one side and on rollers at the foot: the rest follows by inertia.
TEST(Components, InertiaRelievesTheMotionsThatAreLeftFree) {
  const auto report =
      stress(cube(condition("z-", "displacement = ['free', 'free', 0.0]") +
                  test::boundary_text("x+", "traction", {kStress, 0, 0}) + "[run]\ninertia_relief = true\n"));
  for (const auto& t : report.triangles) {
    if (t.region == "x+" || t.region == "x-") {
      EXPECT_NEAR(t.principal[0] / kStress, t.region == "x+" ? 1 : 0, 0.2);
    } else {
      EXPECT_NEAR(t.principal[0] / kStress, t.centroid.x() + 0.5, 0.2);
    }
  }
}

TEST(Components, WhatMakesNoSenseIsRefused) {
  const auto message = [](const std::string& keys) { return refusal_of_scene(cube(condition("z-", keys))); };
  EXPECT_NE(message("displacement = ['free', 'free', 'free']").find("leaves every component free"),
            std::string::npos);
  EXPECT_NE(message("displacement = ['loose', 0, 0]").find("\"free\" where"), std::string::npos);
  EXPECT_NE(message("displacement = [0, 0]").find("a list of 3"), std::string::npos);
  EXPECT_NE(message("displacement = [0, 'free', 0]\ntraction = [1e5, 0, 0]").find("along axis 1"),
            std::string::npos);
  EXPECT_NE(message("displacement = [0, 'free', 0]\nforce = [1e5, 0, 0]").find("contradict"),
            std::string::npos);
  EXPECT_NE(message("axes = [[1, 0, 0], [1, 1, 0], [0, 0, 1]]\nfixed = true").find("right angles"),
            std::string::npos);
}

}  // namespace conchoid
