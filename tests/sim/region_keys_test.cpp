#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/clamp_edges.hpp"
#include "conchoid/sim/fracture.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

// Regions as a scene names them, and what cracks do at the edges of supports.
namespace conchoid {
namespace {

std::string cube(const std::string& rest) {
  return "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) + rest;
}

std::string region(const std::string& keys) {
  return "[[region]]\nname = 'part'\n" + keys + "\n";
}

const std::string kHeld = "[[boundary]]\nregion = 'z-'\nfixed = true\n";

std::string refusal_of(const std::string& text) {
  return test::refusal([&] { prepare(test::scene_from_text(text)); });
}

std::size_t size_of_part(const std::string& keys) {
  const PreparedBody body = prepare(test::scene_from_text(cube(kHeld + region(keys))));
  return find_region(body.regions, "part")->triangles.size();
}

// The cube with two materials and groups: its top is of the second.
std::string write_two_materials(const test::TemporaryFolder& folder) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2);
  std::ofstream out(folder / "two.obj");
  for (const Vec3& x : mesh.positions)
    out << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  for (const bool top : {false, true}) {
    out << "usemtl " << (top ? "lid" : "pot") << "\no jar\ng " << (top ? "cover shiny" : "belly") << '\n';
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if ((unit_normal(mesh, TriId(t)).z() > 0.9) == top) {
        const auto& c = mesh.corners[TriId(t)];
        out << "f " << c[0].index() + 1 << ' ' << c[1].index() + 1 << ' ' << c[2].index() + 1 << '\n';
      }
  }
  return (folder / "two.obj").string();
}

}  // namespace

TEST(RegionKeys, EveryWayToNameAPlace) {
  const std::size_t top = find_region(built_in_model("cube").regions, "z+")->triangles.size();
  EXPECT_EQ(size_of_part("half_spaces = [[0, 0, 1, 0.49]]"), top);
  EXPECT_EQ(size_of_part("box = [[1, 1, 1], [-1, -1, 0.49]]"), top);
  EXPECT_EQ(size_of_part("sphere = [0, 0, 50.49, 50.0]"), top);
  EXPECT_EQ(size_of_part("indenter = [0, 0, 100.5, 100]\nwithin = 0.01"), top);
  EXPECT_EQ(size_of_part("indenter = [0, 0, 100.5, 100]\nindenter_axis = [0, 2, 0]\nwithin = 0.01"), top);
  EXPECT_EQ(size_of_part("nearest = [0.1, 0.2, 0.7]"), 1u);
}

TEST(RegionKeys, AMaterialOrGroupOfTheFileAlsoOfRemeshedBodies) {
  const test::TemporaryFolder folder;
  const std::string file = write_two_materials(folder);
  for (const auto& [remesh, key] : {std::pair("", "material = 'lid'"),
                                    {"", "group = 'shiny'"},
                                    {"remesh = 200\n", "material = 'lid'"},
                                    {"remesh = 200\n", "group = 'cover'"}}) {
    const Scene scene = test::scene_from_text(test::mesh_body_text(file) + remesh + test::material_text() +
                                              region(key) + "[[boundary]]\nregion = 'part'\nfixed = true\n");
    const PreparedBody body = prepare(scene);
    double area = 0;
    for (TriId t : find_region(body.regions, "part")->triangles) {
      EXPECT_NEAR(unit_normal(body.surface, t).z(), 1, 1e-6);
      area += area_vector(body.surface, t).norm();
    }
    EXPECT_NEAR(area, 1, 1e-3);
  }
  const std::string message =
      refusal_of(test::mesh_body_text(file) + test::material_text() + region("material = 'rim'"));
  EXPECT_NE(message.find("but pot, lid"), std::string::npos) << message;
  const std::string group =
      refusal_of(test::mesh_body_text(file) + test::material_text() + region("group = 'rim'"));
  EXPECT_NE(group.find("but belly jar, cover shiny jar"), std::string::npos) << group;
  const Scene all = test::scene_from_text(test::mesh_body_text(file) + test::material_text() +
                                          region("group = 'jar'\nbox = [[-1, -1, 0.4], [1, 1, 1]]") +
                                          "[[boundary]]\nregion = 'part'\nfixed = true\n");
  EXPECT_EQ(find_region(prepare(all).regions, "part")->triangles.size(), 8u) << "an object is a group, too";
}

TEST(RegionKeys, WhatMakesNoSenseIsRefused) {
  const auto message = [](const std::string& keys) { return refusal_of(cube(kHeld + region(keys))); };
  EXPECT_NE(message("initiation = false").find("says nothing about where"), std::string::npos);
  EXPECT_NE(message("box = [[0, 0, 0]]").find("must hold 2"), std::string::npos);
  EXPECT_NE(message("sphere = [0, 0, 0, -1]").find("radius -1"), std::string::npos);
  EXPECT_NE(message("within = 0.1\nnearest = [0, 0, 1]").find("goes with `indenter`"), std::string::npos);
  EXPECT_NE(message("indenter = [0, 0, 9, 1]").find("lacks within"), std::string::npos);
  EXPECT_NE(message("sphere = [9, 0, 0, 1]").find("widen it"), std::string::npos);
  EXPECT_NE(message("material = 'glass'").find("names no materials"), std::string::npos);
  EXPECT_NE(message("group = 'glass'").find("names no groups"), std::string::npos);
}

TEST(ClampEdges, AClampHasThemAndAPlaneOfSymmetryHasNone) {
  const auto edges = [](const std::string& conditions) {
    return clamp_edges(prepare(test::scene_from_text(cube(conditions))));
  };
  const auto clamp = edges(kHeld);
  double length = 0;
  for (const ClampEdge& e : clamp) {
    EXPECT_NEAR(e.a.z(), -0.5, 1e-12);
    EXPECT_NEAR(e.b.z(), -0.5, 1e-12);
    length += (e.b - e.a).norm();
  }
  EXPECT_NEAR(length, 4, 1e-9);
  EXPECT_TRUE(edges("[[boundary]]\nregion = 'z-'\ndisplacement = ['free', 'free', 0.0]\n").empty());
  EXPECT_FALSE(edges(region("nearest = [0, 0, -1]") +
                     "[[boundary]]\nregion = 'part'\ndisplacement = ['free', 'free', 0.0]\n")
                   .empty());
}

// A cube pulled from its clamp breaks at the clamp's corner, which says nothing; kept away from there it breaks
// where it may.
TEST(ClampEdges, ACrackThatStartsAtOneIsToldFromOthersAndCanBeKeptAway) {
  const std::string pull = test::boundary_text("z+", "traction", {0, 0, 7.7e7});
  const auto first_step = [](const std::string& text, Vec3& at) {
    const Scene scene = test::scene_from_text(text);
    const auto body = std::make_shared<const PreparedBody>(prepare(scene));
    Fracture fracture(body, load_of(scene, *body), scene.run);
    const StepReport report = fracture.step();
    EXPECT_EQ(report.new_cracks, 1u);
    at = report.start.position;
    std::string said;
    for (const std::string& warning : report.warnings)
      said += warning;
    return said;
  };
  Vec3 at = Vec3::Zero();
  const std::string said = first_step(cube(kHeld + pull), at);
  EXPECT_LT(at.z(), -0.3);
  EXPECT_NE(said.find("at the edge of the support 'z-'"), std::string::npos) << said;
  EXPECT_NE(said.find("initiation = false"), std::string::npos) << said;
  const std::string own = "[[region]]\nname = 'z-'\nhalf_spaces = [[0, 0, -1, 0.49]]\n";  // comes first
  const std::string kept = first_step(
      cube(own + kHeld + pull + region("half_spaces = [[0, 0, -1, 0.05]]\ninitiation = false")), at);
  EXPECT_GT(at.z(), -0.3);
  EXPECT_EQ(kept.find("support"), std::string::npos) << kept;
}

}  // namespace conchoid
