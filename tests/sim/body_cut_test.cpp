#include "conchoid/sim/body_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/core/random.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "hollow_bodies.hpp"
#include "intersect/cut_shapes.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

constexpr double kEdge = 0.1;  // r̄

PreparedBody cube() {
  return prepare(test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(kEdge, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 1e7}) + "[run]\ninertia_relief = true\n"));
}

/// Across most of the cube, its nodes scattered about their plane.
TriMesh ragged_sheet(Random& random, double scatter, const Vec3& tilt) {
  return shapes::sheet(-0.7, 0.38, -0.7, 0.7, 22, 28, [&](double u, double v) {
    return Vec3(u, v, 0.013 + tilt[0] * u + tilt[1] * v + tilt[2] + random.uniform(-scatter, scatter));
  });
}

BodyCut along_ligament(const PreparedBody& body, std::vector<TriMesh> sheets) {
  RunSpec run;
  run.smallest_fragment = 2e-3;  // sheets that cross enclose crumbs
  BodyCut cut = cut_body(body, run, std::move(sheets));
  if (!cut.parted())
    cut_ligament(
        cut, body, run,
        find_last_ligaments(body.detailed, join(cut.sheets), body.crack_edge, LigamentsOf::each_and_all));
  return cut;
}

void expect_clean_halves(const PreparedBody& body, const BodyCut& cut) {
  ASSERT_TRUE(cut.parted());
  double volume = 0;
  for (std::size_t i = 0; i < cut.fragments.size(); ++i) {
    const Fragment& f = cut.fragments[i];
    EXPECT_TRUE(f.watertight);
    EXPECT_TRUE(self_intersections({cut.opened.at(i), f.mesh.corners}, 1).empty());
    volume += f.volume;
  }
  EXPECT_NEAR(volume, enclosed_volume(body.detailed), 1e-9 * volume);
  EXPECT_GT(cut.fragments[1].volume, 0.4 * volume);
}

// All of it, however smooth: along the crack as exactly as it is known there, and without it a cut through the body.
TEST(BodyCut, ASurfaceBetweenTheSidesPartsTheBodyAlone) {
  Random random(1);
  const TriMesh body = cube().detailed, sheet = ragged_sheet(random, 0, Vec3::Zero());
  const auto found = find_last_ligaments(body, sheet, kEdge);
  ASSERT_EQ(found.size(), 1u);
  for (const DividingSurface& how : {DividingSurface{0, false}, {5, false}, {20, false}, {20, true}}) {
    const TriMesh surface = LigamentSurfaces(found[0], sheet).between_sides(how);
    EXPECT_TRUE(self_intersections(surface, 1).empty());
    for (const Vec3& x : surface.positions)
      EXPECT_LT(std::abs(x.z() - 0.013), x.x() < 0.36 ? 1e-9 : 0.1 * kEdge) << how.smoothing << how.halved;
    const auto pieces = cut_into_fragments(body, {surface}, {});
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_NEAR(pieces[1].volume, 0.487, 2e-3);
  }
}

TEST(BodyCut, JoinsACrackThatIsPlain) {
  const PreparedBody body = cube();
  Random random(1);
  const BodyCut cut = along_ligament(body, {ragged_sheet(random, 0, Vec3::Zero())});
  expect_clean_halves(body, cut);
  EXPECT_EQ(cut.stands_for, 0);
  EXPECT_TRUE(cut.warnings.empty());
  EXPECT_LT(surface_area(cut.ligament), 0.5);
}

// Three sheets that pass through each other again and again, none farther than a cell from the next: whatever joins them
// leaves crumbs and folds.
TEST(BodyCut, GoesPastCracksTooRaggedToBeJoined) {
  const PreparedBody body = cube();
  Random random(1);
  std::vector<TriMesh> sheets;
  for (int i = 0; i < 3; ++i)
    sheets.push_back(ragged_sheet(random, 0.004, 0.003 * random.unit_vector()));
  const BodyCut cut = along_ligament(body, sheets);
  expect_clean_halves(body, cut);
  EXPECT_GT(cut.stands_for, 0);
  EXPECT_EQ(cut.warnings.size(), 1u);
  const double section = cut.fragments[0].volume + cut.fragments[1].volume;  // of the unit cube
  EXPECT_NEAR(surface_area(cut.ligament), section, 0.1 * section);
  // It stands for all of the sheets.
  for (const TriMesh& sheet : cut.sheets)
    for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
      EXPECT_GT(centroid(sheet, TriId(t)).cwiseAbs().maxCoeff(), 0.5);
}

// A round column whose boundary elements are a square prism: a crack through the prism leaves half as much of the column
// as it has parted, too much for a ligament, but the elements are apart.
TEST(BodyCut, WhatComesOffTheElementsComesOffTheBody) {
  const test::TemporaryFolder folder;
  PreparedBody body = prepare(test::scene_from_text(
      test::mesh_body_text(test::write_mesh_in(folder, "prism.obj", shapes::column(4))) +
      test::material_text() + test::resolution_text(0.05, 0.01)));
  body.detailed = shapes::column(48);
  const TriMesh sheet = shapes::sheet(-0.145, 0.145, -0.145, 0.145, 30, 30, [](double u, double v) {
    return Vec3((u - v) / std::sqrt(2.0), (u + v) / std::sqrt(2.0), 0.013);
  });
  const auto all = [](const LastLigament&) { return true; };
  EXPECT_TRUE(find_last_ligaments(body.detailed, sheet, body.crack_edge).empty());
  const BodyCut cut = cut_or_break(body, {}, {sheet}, sheet, {LigamentsOf::each, all, std::nullopt});
  ASSERT_EQ(cut.fragments.size(), 2u);
  const double volume = enclosed_volume(body.detailed);
  EXPECT_NEAR(cut.fragments[0].volume + cut.fragments[1].volume, volume, 1e-9 * volume);
  EXPECT_NEAR(cut.fragments[1].volume, (1 - 0.013) / 2 * volume, 0.01 * volume);
  EXPECT_FALSE(cut_or_break(body, {}, {sheet}, {}, {LigamentsOf::each, all, std::nullopt}).parted());
}

}  // namespace
}  // namespace conchoid
