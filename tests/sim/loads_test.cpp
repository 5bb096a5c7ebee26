#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/piece_scene.hpp"
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

/// Force [N], and moment [N m] about the middle of the cube's upper side, of a scene's tractions.
std::pair<Vec3, Vec3> resultant_on_top(const Scene& scene) {
  const PreparedBody body = prepare(scene);
  const LoadCase load = load_of(scene, body);
  Vec3 f = Vec3::Zero(), m = Vec3::Zero();
  for (std::size_t t = 0; t < load.traction.size(); ++t) {
    const Vec3 part = area_vector(body.surface, TriId(t)).norm() * load.traction[t];
    f += part;
    m += cross(centroid(body.surface, TriId(t)) - Vec3(0, 0, 0.5), part);
  }
  return {f, m};
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
  EXPECT_NE(message("displacement = [0, 'free', 0]\nforce = [1e5, 0, 0]").find("along axis 1"),
            std::string::npos);
  EXPECT_NE(message("displacement = [0, 'free', 0]\nforce = [0, 1e5, 0]\npressure = 1").find("contradict"),
            std::string::npos);
  EXPECT_NE(message("displacement = ['free', 'free', 0]\npressure = 1e5").find("nothing feels it"),
            std::string::npos);
  EXPECT_NE(message("displacement = ['free', 'free', 0]\nmoment = [1, 0, 0]").find("cannot carry the moment"),
            std::string::npos);
  EXPECT_NE(message("fixed = true\npressure = 1e5").find("contradict"), std::string::npos);
  EXPECT_NE(message("axes = [[1, 0, 0], [1, 1, 0], [0, 0, 1]]\nfixed = true").find("right angles"),
            std::string::npos);
}

TEST(Loads, PressureFromAllSidesIsHydrostatic) {
  std::string conditions;
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
    conditions += condition(side, fmt::format("pressure = {}", kStress));
  EXPECT_LT(error_of(stress(cube(conditions)), Vec3::Constant(-kStress)), 1e-4);
}

TEST(Loads, ForceAndMomentHaveExactlyTheirResultant) {
  const Vec3 force(1e3, -2e3, 5e2), moment(300, -120, 450);
  const Scene scene = test::scene_from_text(
      cube(condition("z-", "fixed = true") +
           condition("z+", fmt::format("force = {}\nmoment = {}", test::text(force), test::text(moment)))));
  const auto [f, m] = resultant_on_top(scene);
  EXPECT_LT((f - force).norm(), 1e-9 * force.norm());
  EXPECT_LT((m - moment).norm(), 1e-9 * moment.norm());
}

// On rollers, what is free carries the load; what is held gets nothing of it.
TEST(Loads, ForceMomentAndPressureActBesideAComponentThatIsHeld) {
  const Vec3 force(1e3, -2e3, 0), moment(0, 0, 450);
  const std::string roller = "displacement = ['free', 'free', 0.0]\n";
  const Scene scene = test::scene_from_text(
      cube(condition("z-", "fixed = true") +
           condition("z+", roller + fmt::format("force = {}\nmoment = {}", test::text(force),
                                                test::text(moment)))));
  const auto [f, m] = resultant_on_top(scene);
  EXPECT_LT((f - force).norm(), 1e-9 * force.norm());
  EXPECT_LT((m - moment).norm(), 1e-9 * moment.norm());
  // Pressed on two sides, which slide along a wall that holds them across: σ_y = −p, σ_z = ν σ_y, σ_x = 0.
  const std::string pressed = fmt::format("displacement = ['free', 'free', 0.0]\npressure = {}", kStress);
  const auto report = stress(cube(condition("z-", roller) + condition("z+", roller) +
                                  condition("y-", pressed) + condition("y+", pressed)));
  EXPECT_LT(error_of(report, {0, -0.327 * kStress, -kStress}), 1e-4);
}

TEST(Loads, EndMomentsBendABarUniformly) {
  const test::TemporaryFolder folder;
  const double b = 0.8, h = 1, moment = kStress * b * h * h / 6;  // the outermost fibre has kStress
  const auto report =
      stress(test::mesh_body_text(test::write_mesh_in(folder, "bar.obj", box_mesh({4, b, h}, 16, 4, 4))) +
             test::material_text() + test::region_text("left", "[-1, 0, 0, 1.99]") +
             test::region_text("right", "[1, 0, 0, 1.99]") +
             condition("left", fmt::format("moment = [0, {}, 0]", -moment)) +
             condition("right", fmt::format("moment = [0, {}, 0]", moment)));
  int counted = 0;
  for (const auto& t : report.triangles)
    if (std::abs(t.centroid.x()) < 1 && std::abs(std::abs(t.centroid.z()) - h / 2) < 1e-9) {
      ++counted;
      EXPECT_NEAR(t.principal[t.centroid.z() > 0 ? 0 : 2] / kStress, t.centroid.z() > 0 ? 1 : -1, 0.03);
    }
  EXPECT_GT(counted, 0);
}

TEST(Loads, AMomentThatNoTractionCanMakeIsRefused) {
  const test::TemporaryFolder folder;
  const std::string message = refusal_of_scene(
      test::mesh_body_text(test::write_mesh_in(folder, "box.obj", box_mesh({1, 1, 1}, 1, 1, 1))) +
      test::material_text() + test::region_text("top", "[0, 0, 1, 0.49]") +
      test::region_text("foot", "[0, 0, -1, 0.49]") + condition("foot", "fixed = true") +
      condition("top", "moment = [1, 2, 0]"));
  EXPECT_NE(message.find("'top' cannot carry the moment"), std::string::npos) << message;
}

TEST(Loads, WeightStrainsWhatIsHeldAndRotationWhatIsFree) {
  const std::string gravity = "[body_force]\ngravity = [0, 0, -9.81]\n";
  const auto loaded = [](const std::string& text) { return is_loaded(test::scene_from_text(text)); };
  EXPECT_TRUE(loaded(cube(condition("z+", "fixed = true") + gravity)));
  EXPECT_FALSE(loaded(cube(gravity)));
  EXPECT_TRUE(loaded(cube("[body_force]\nspin = [0, 0, 3]\n")));
  EXPECT_TRUE(loaded(cube(condition("z+", "pressure = 1e5"))));
  EXPECT_FALSE(
      loaded(cube(condition("z+", "fixed = true") + condition("x-", "displacement = [0, 'free', 0]"))));
  EXPECT_NE(refusal_of_scene(cube(gravity)).find("out of balance"), std::string::npos);
  const auto falls = stress(cube(gravity + "[run]\ninertia_relief = true\n"));
  EXPECT_LT(error_of(falls, Vec3::Zero()), 1e-12) << "a body in free fall is without stress";
}

// The held half stays under its weight, what has come off falls and keeps the axis about which it turned.
TEST(Loads, PiecesKeepPressureMomentAndBodyForce) {
  const Scene scene = test::scene_from_text(cube(
      condition("z+", "force = [0, 0, 1e3]\nmoment = [100, 200, 300]") + condition("z-", "fixed = true") +
      condition("x+", "displacement = ['free', 0.0, 'free']\npressure = 2e5") +
      "[body_force]\ngravity = [0, 0, -9.81]\nspin = [0, 0, 2]\n"));
  Body moved = scene_body(scene);
  for (TriMesh* mesh : {&moved.surface, &moved.detailed})
    for (Vec3& x : mesh->positions)
      x += Vec3(3, 4, 5);
  const PreparedBody body = prepare(scene, moved);
  Fragment whole;  // all of the body, as a piece of it
  whole.mesh = moved.detailed;
  for (std::size_t t = 0; t < whole.mesh.triangle_count(); ++t) {
    whole.face_kind.push_back(FaceKind::original);
    whole.source.emplace_back(t);
  }
  const PieceScene piece = scene_of_piece(scene, body, whole);
  ASSERT_EQ(piece.scene.boundary.size(), 3u);
  EXPECT_EQ(*piece.scene.body_force.on_axis, Vec3(3, 4, 5));
  EXPECT_TRUE(is_loaded(piece.scene));
  const PreparedBody again = prepare(piece.scene, piece.body);
  const auto resultant_of = [](const PreparedBody& of, const LoadCase& load, Vec3& moment) {
    Vec3 force = Vec3::Zero();
    for (TriId t : find_region(of.regions, "z+")->triangles) {
      const Vec3 part = area_vector(of.surface, t).norm() * load.traction[t.index()];
      force += part;
      moment += cross(centroid(of.surface, t), part);
    }
    return force;
  };
  Vec3 m1 = Vec3::Zero(), m2 = Vec3::Zero();
  const Vec3 f1 = resultant_of(body, load_of(scene, body), m1),
             f2 = resultant_of(again, load_of(piece.scene, again), m2);
  EXPECT_LT((f1 - f2).norm(), 1e-2 * f1.norm());
  EXPECT_LT((m1 - m2).norm(), 5e-2 * m1.norm()) << "as far as the new elements follow the region";
}

}  // namespace conchoid
