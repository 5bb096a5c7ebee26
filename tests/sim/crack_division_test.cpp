#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/predicted_opening.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/surface/separation.hpp"
#include "scenes.hpp"

// The surface is divided near cracks before it is cut; what that adds to the boundary elements stays when a crack grows.
namespace conchoid {
namespace {

constexpr double kEdge = 0.1;  // r̄
const ElasticConstants kGlassy{3.1e9, 0.327};

TriMesh cube() {
  return built_in_model("cube").mesh;
}

// From the side of the cube, askew; grown by so many strips.
CrackState edge_crack(int strips, NearCracks near = NearCracks::divided) {
  TriMesh disc = disc_crack({0.483, 0.021, 0.034}, {0.1, 0.2, 1}, 0.2, {.edge = kEdge});
  for (int i = 0; i < strips; ++i)
    disc = extend_sheet_beyond(disc, boundary_edges(disc), kEdge);
  CrackState crack;
  append_part(crack.sheet, disc);
  update_crack(crack, cube(), kEdge, near);
  return crack;
}

std::shared_ptr<const BodyOperator> held_cube() {
  const TriMesh mesh = cube();
  std::vector<BoundaryKind> kinds(mesh.triangle_count(), BoundaryKind::traction);
  for (std::size_t t = 0; t < kinds.size(); ++t)
    if (unit_normal(mesh, TriId(t)).z() < -0.9) kinds[t] = BoundaryKind::displacement;
  return std::make_shared<const BodyOperator>(mesh, kinds, kGlassy);
}

LoadCase pulled() {
  const TriMesh mesh = cube();
  LoadCase load{std::vector<Vec3>(mesh.triangle_count(), Vec3::Zero()),
                IdVector<NodeId, Vec3>(mesh.node_count(), Vec3::Zero()),
                {}};
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (unit_normal(mesh, TriId(t)).z() > 0.9) load.traction[t] = {1e5, 0, 1e6};
  return load;
}

}  // namespace

TEST(CrackDivision, OpensCracksAsTheHatsOfTheCutSurfaceDo) {
  const auto body = held_cube();
  const CrackState crack = edge_crack(0);
  ASSERT_FALSE(crack.division.halves.empty());
  CrackedBody by_halves(body, pulled()), by_pieces(body, pulled());
  by_halves.set_crack(crack.cut, crack.division);
  by_pieces.set_crack(crack.cut);
  by_halves.solve();
  by_pieces.solve();
  ASSERT_EQ(by_halves.statistics().functions, by_pieces.statistics().functions);
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < by_pieces.opening().size(); ++i) {
    largest = std::max(largest, by_pieces.opening()[NodeId(i)].norm());
    difference =
        std::max(difference, (by_pieces.opening()[NodeId(i)] - by_halves.opening()[NodeId(i)]).norm());
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(difference, 1e-7 * largest);
  EXPECT_NEAR(by_halves.energy(), by_pieces.energy(), 1e-7 * by_pieces.energy());
  const std::vector<Mat3> a = by_halves.surface_stress(), b = by_pieces.surface_stress();
  for (std::size_t t = 0; t < a.size(); ++t)
    EXPECT_LT((a[t] - b[t]).norm(), 1e-6 * 1e6);
}

// A leaf of the crack lies in a face of the body but for round-off, so that no triangle is a sliver: the flake above it
// would leave the system singular.
TEST(CrackDivision, SheetsThatLieOnAFaceAreMovedOffIt) {
  constexpr double top = 0.5 - 1e-9;
  TriMesh leaf;
  for (int i = 0; i < 3; ++i)
    for (const Vec2& yz : {Vec2(0.02, 0.3), Vec2(0.02, 0.4), Vec2(0.02, top), Vec2(0.12, top)})
      leaf.positions.push_back({-0.1 + 0.1 * i, yz[0], yz[1]});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a(4 * i + k), b(4 * i + k + 1), c(4 * i + k + 4), d(4 * i + k + 5);
      leaf.corners.push_back({a, b, d});
      leaf.corners.push_back({a, d, c});
    }
  CrackState crack;
  append_part(crack.sheet, leaf);
  update_crack(crack, cube(), kEdge);
  EXPECT_NE(crack.displacement, 0);
  const ClosestPointTree surface(cube());
  for (std::size_t t = 0; t < crack.trimmed.triangle_count(); ++t)
    EXPECT_GT(surface.closest(centroid(crack.trimmed, TriId(t))).squared_distance, std::pow(1e-3 * kEdge, 2));
  CrackedBody body(held_cube(), pulled());
  body.set_crack(crack.cut, crack.division);
  EXPECT_NO_THROW(body.solve());
}

TEST(CrackDivision, WhatGrowthDividesFurtherChangesNoFunctionOfBefore) {
  const auto body = held_cube();
  const CrackState before = edge_crack(0), after = edge_crack(2);
  const auto middles = [&](const CrackState& crack) {
    std::set<NodeId> nodes;
    for (const HalfTriangle& half : crack.division.halves)
      nodes.insert(half.corners[2]);
    std::set<std::vector<double>> keys;
    for (const EnrichmentFunction& f :
         make_enriched_space(crack.cut, body->surface(), body->kinds(), crack.division).functions)
      if (f.kind == EnrichmentKind::hat && nodes.contains(f.node)) keys.insert(f.key);
    return keys;
  };
  const auto few = middles(before), many = middles(after);
  ASSERT_GT(few.size(), 20u);
  ASSERT_GT(many.size(), few.size());
  for (const std::vector<double>& key : few)
    EXPECT_TRUE(many.contains(key));
}

TEST(CrackDivision, ASheetThatWasDisplacedStaysDisplaced) {
  const TriMesh mesh = cube();
  TriMesh disc = disc_crack({0.5, 0, 0}, Vec3::UnitZ(), 0.2, {.edge = kEdge});
  for (Vec3& x : disc.positions)  // through nodes of the cube and along its edges
    x.z() = 0.1;
  CrackState crack;
  append_part(crack.sheet, disc);
  update_crack(crack, mesh, kEdge);
  const double displaced = crack.displacement;
  for (int i = 0; i < 2; ++i) {
    update_crack(crack, mesh, kEdge);
    EXPECT_EQ(crack.displacement, displaced);
  }
  CrackState moved;  // where it lies well as it is, as after growth
  append_part(moved.sheet, disc_crack({0.483, 0.021, 0.034}, {0.1, 0.2, 1}, 0.2, {.edge = kEdge}));
  moved.displacement = 0.01;
  update_crack(moved, mesh, kEdge);
  EXPECT_EQ(moved.displacement, 0.01);
}

// Discs across the side of the cube, anyhow.
CrackState random_disc(Random& random) {
  const Vec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), 1);
  CrackState crack;
  append_part(crack.sheet, disc_crack({0.49, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)}, normal,
                                      0.2, {.edge = kEdge}));
  update_crack(crack, cube(), kEdge);
  return crack;
}

// Nodes that merge at the mouth could lay a triangle of the crack into the face: twice in a thousand discs.
TEST(CrackDivision, NoTriangleOfACrackLiesInAFace) {
  Random random(7);
  const ClosestPointTree surface(cube());
  for (int i = 0; i < 1000; ++i) {
    const CrackState crack = random_disc(random);
    for (std::size_t t = 0; t < crack.trimmed.triangle_count(); ++t)
      ASSERT_GT(surface.closest(centroid(crack.trimmed, TriId(t))).squared_distance, 0) << i;
  }
}

// Another displacement moves every element: what is a sliver for a crack that starts is none for one that has grown on it.
TEST(CrackDivision, ASlightSliverDoesNotMoveACrackThatHasGrown) {
  Random random(7);
  int moved = 0, kept = 0;
  for (int i = 0; i < 1000; ++i) {  // some of them leave slight slivers
    CrackState crack = random_disc(random);
    if (crack.displacement == 0) continue;
    ++moved;
    crack.displacement = 0;
    update_crack(crack, cube(), kEdge);
    if (crack.displacement == 0) ++kept;
  }
  EXPECT_GT(moved, 1);
  EXPECT_EQ(kept, moved);
}

// A corner that comes off would float; held, the crack beside it opens as without the cut through the corner.
TEST(CrackDivision, ACrumbThatComesOffIsHeld) {
  const TriMesh disc = disc_crack({0, 0, 0}, Vec3::UnitZ(), 0.25, {.edge = kEdge});
  const TriMesh corner =
      disc_crack(Vec3::Constant(1.32 / 3), Vec3(1, 1, 1).normalized(), 0.4, {.edge = kEdge});
  const auto largest_opening = [](const CrackState& crack) {
    CrackedBody body(held_cube(), pulled());
    body.set_crack(crack.cut, crack.division);
    body.solve();
    double largest = 0;
    for (const Vec3& u : body.opening())
      largest = std::max(largest, u.norm());
    return largest;
  };
  CrackState alone, both;
  append_part(alone.sheet, disc);
  update_crack(alone, cube(), kEdge);
  append_part(both.sheet, disc);
  append_part(both.sheet, corner);
  update_crack(both, cube(), kEdge);
  const double off = std::pow(0.18, 3) / 6;
  EXPECT_EQ(count_pieces(both.cut), 2u);
  EXPECT_THROW(largest_opening(both), SingularSystem);
  EXPECT_FALSE(hold_crumbs(both, 0.5 * off));
  EXPECT_TRUE(hold_crumbs(both, 2 * off));
  EXPECT_EQ(count_pieces(both.cut), 1u);
  EXPECT_EQ(both.trimmed.triangle_count(), alone.trimmed.triangle_count());
  EXPECT_EQ(both.points.size(), alone.points.size());
  EXPECT_NEAR(largest_opening(both), largest_opening(alone), 2e-3 * largest_opening(alone));
  EXPECT_FALSE(hold_crumbs(both, 1));
}

TEST(CrackDivision, NothingIsDividedForWhatIsNotSolved) {
  const CrackState crack = edge_crack(0, NearCracks::as_it_is);
  EXPECT_TRUE(crack.division.halves.empty());
  EXPECT_LT(crack.cut.surface.size(), edge_crack(0).cut.surface.size());
  const Scene scene = test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(kEdge, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 9e7}) +
      test::boundary_text("z-", "traction", {0, 0, -9e7}) + "[run]\ninertia_relief = true\n");
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  const SifSettings sif = sif_settings(scene.run);
  for (const int every : {0, 2}) {
    BemOpening bem(body->elastic, load_of(scene, *body), sif);
    const KeptOpening kept({bem, body->material, *body, sif, every});
    EXPECT_TRUE(kept.solves(0));
    EXPECT_FALSE(kept.solves(1));
    EXPECT_EQ(kept.solves(2), every == 2);
  }
}

}  // namespace conchoid
