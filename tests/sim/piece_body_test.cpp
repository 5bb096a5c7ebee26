#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/tidy.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/sim/run_identity.hpp"
#include "scenes.hpp"

// A piece is a body again: in memory, with its cracks, in the material it was cut from.
namespace conchoid {
namespace {

const std::string kLayers =
    "[material.toughness_field]\nkind = 'layers'\ndirection = [0.3, 0.0, 1.0]\nwavelength = 0.17\n"
    "amplitude = 0.3\n";

std::string half_space(const std::string& name, const Vec3& n, double d) {
  return test::region_text(name, test::half_space_text(n, d));
}

RunOptions quiet() {
  RunOptions options;
  options.progress = false;
  return options;
}

double volume(const std::vector<Fragment>& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0,
                         [](double sum, const Fragment& f) { return sum + f.volume; });
}

// Pulled along x at its ends, wherever it comes from.
Scene pulled_along_x(double low, double high, double stress, const std::string& material) {
  return test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + material + test::resolution_text(0.1, 0.02) +
      half_space("left", -Vec3::UnitX(), -low) + half_space("right", Vec3::UnitX(), high) +
      test::boundary_text("left", "traction", {-stress, 0, 0}) +
      test::boundary_text("right", "traction", {stress, 0, 0}) + "[run]\ninertia_relief = true\n");
}

Scene layered_cube() {
  return test::scene_from_text("[body]\nmodel = 'cube'\n" + test::material_text() + kLayers +
                               test::resolution_text(0.1, 0.02) +
                               test::boundary_text("z+", "traction", {0, 0, 9e7}) +
                               test::boundary_text("z-", "traction", {0, 0, -9e7}));
}

}  // namespace

TEST(PieceBody, BreaksAgainInTheSameLayers) {
  const Scene first = layered_cube();
  const Body cube = scene_body(first);
  const RunResult broken = run_body(first, cube, quiet());
  ASSERT_EQ(broken.document.stop, StopReason::separated);
  ASSERT_EQ(broken.fragments.size(), 2u);
  const Fragment& larger = broken.fragments.front();

  const Body piece = body_from_fragment(larger, frame_of_pieces(cube), {.remesh = 400});
  EXPECT_TRUE(find_defects(piece.surface).empty());
  const Scene second = pulled_along_x(-0.48, 0.48, 1.0e8, kLayers);
  const RunResult again = run_body(second, piece, quiet());
  EXPECT_EQ(again.document.stop, StopReason::separated);
  ASSERT_EQ(again.fragments.size(), 2u);
  EXPECT_NEAR(volume(again.fragments), larger.volume, 1e-9);
  EXPECT_NEAR(volume(again.fragments), again.document.body_volume, 1e-9);
  for (const Fragment& f : again.fragments)
    EXPECT_TRUE(f.watertight);

  const PreparedBody before = prepare(first, cube), after = prepare(second, piece);
  double least = 2, most = 0;
  for (const Vec3& x : piece.surface.positions) {
    const FieldSample there = before.toughness.at(x - before.origin),
                      here = after.toughness.at(x - after.origin);
    EXPECT_NEAR(here.value, there.value, 1e-12);
    EXPECT_LT((here.gradient - there.gradient).norm(), 1e-10);
    least = std::min(least, here.value);
    most = std::max(most, here.value);
  }
  EXPECT_LT(least, 0.75);  // the layers are seen at all
  EXPECT_GT(most, 1.25);
}

TEST(PieceBody, AMovedPieceTakesItsMaterialAlong) {
  const Scene scene = layered_cube();
  const Body rest = scene_body(scene);
  Body moved = rest;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(3, -1, 2);
  for (TriMesh* mesh : {&moved.surface, &moved.detailed})
    for (Vec3& x : mesh->positions)
      x = turn * x + shift;
  moved.material.turn = turn.transpose();
  moved.material.shift = -(turn.transpose() * shift);
  moved.material.center = bounding_box(rest.detailed).center();
  Scene free = scene;
  free.boundary.clear();
  const PreparedBody a = prepare(free, rest), b = prepare(free, moved);
  for (std::size_t i = 0; i < rest.surface.node_count(); ++i) {
    const FieldSample at_rest = a.toughness.at(rest.surface.positions[NodeId(i)] - a.origin);
    const FieldSample there = b.toughness.at(moved.surface.positions[NodeId(i)] - b.origin);
    EXPECT_NEAR(there.value, at_rest.value, 1e-12);
    EXPECT_LT((there.gradient - turn * at_rest.gradient).norm(), 1e-10);
  }
}

// Where slits have gone from its surface, parts may touch in a node that lay between them: no surface of a body, but a
// hair apart they are.
TEST(PieceBody, PartsThatTouchInANodeAreTakenApart) {
  TriMesh two = box_mesh(Vec3::Ones(), 2, 2, 2), other = two;
  for (Vec3& x : other.positions)
    x += Vec3::Ones();
  two = join({two, other});
  // A flat crumb of two pairs of faces that hangs at one of its nodes.
  const NodeId hung(0), a = two.positions.add(two.positions[hung] - Vec3(0.1, 0, 0)),
                        b = two.positions.add(two.positions[hung] - Vec3(0.1, 0.1, 0)),
                        c = two.positions.add(two.positions[hung] - Vec3(0.1, 0.05, 1e-10));
  for (const auto& corners : {std::array{hung, a, b}, {hung, b, c}, {hung, c, a}, {a, c, b}})
    two.corners.push_back(corners);
  const double volume = enclosed_volume(two);
  merge_equal_nodes(two);
  drop_unused_nodes(two);
  ASSERT_FALSE(find_defects(two).empty());
  Fragment piece;
  piece.mesh = two;
  piece.face_kind.assign(two.triangle_count(), FaceKind::original);
  for (std::size_t t = 0; t < two.triangle_count(); ++t)
    piece.source.emplace_back(t);
  const Body body = body_from_fragment(piece, {}, {});
  EXPECT_TRUE(find_defects(body.detailed).empty());
  EXPECT_EQ(body.detailed.triangle_count(), two.triangle_count() - 4);
  EXPECT_EQ(body.regions[0].triangles.size(), body.detailed.triangle_count());
  EXPECT_NEAR(enclosed_volume(body.detailed), volume, 1e-3);
}

// A deep edge crack separates the body while a small crack beside it feels too little to grow. In the piece
// that holds it, under a larger load, it goes on.
TEST(PieceBody, AnUnfinishedCrackGoesOnInThePiece) {
  const std::string material = test::material_text({.strength = 1e12});
  const Scene first = test::scene_from_text(
      "[body]\nmodel = 'edge-crack-cube'\n" + material + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 1.2e6}) +
      test::boundary_text("z-", "displacement", {0, 0, 0}) +
      "[[crack]]\nkind = 'disc'\ncenter = [-0.2, 0.03, 0.25]\nnormal = [0, 0, 1]\nradius = 0.12\n");
  const RunResult broken = run_scene(first, quiet());
  ASSERT_EQ(broken.document.stop, StopReason::separated);
  ASSERT_EQ(broken.fragments.size(), 2u);
  const auto holds_crack = [](const Fragment& f) { return !f.unfinished.sheets.empty(); };
  const bool first_is_upper = broken.fragments[0].center_of_mass.z() > 0;
  const Fragment& upper = broken.fragments[first_is_upper ? 0 : 1];
  ASSERT_TRUE(holds_crack(upper));
  EXPECT_FALSE(holds_crack(broken.fragments[first_is_upper ? 1 : 0]));
  ASSERT_EQ(upper.unfinished.sheets.size(), 1u);
  const double area = surface_area(upper.unfinished.sheets[0]);
  EXPECT_NEAR(area, 3.1416 * 0.12 * 0.12, 0.1 * area);

  const Body piece = body_from_fragment(upper, {}, {.remesh = 400});
  EXPECT_TRUE(find_defects(piece.detailed).empty()) << "no slit is left in the surface";
  EXPECT_NEAR(enclosed_volume(piece.detailed), upper.volume, 1e-9);
  Scene second = test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + material + test::resolution_text(0.1, 0.02) +
      half_space("top", Vec3::UnitZ(), 0.48) + test::boundary_text("top", "traction", {0, 0, 8e6}));
  second.boundary.push_back({.region = "fracture", .kind = ConditionKind::displacement, .where = "the test"});
  Body stray = piece;  // what the elements leave out ends there
  stray.cracks.push_back(disc_crack({0.2, 0.1, 0.7}, Vec3::UnitZ(), 0.02, {.edge = 0.01}));
  EXPECT_EQ(prepare(second, stray).cracks.size(), prepare(second, piece).cracks.size());
  const RunResult again = run_body(second, piece, quiet());
  EXPECT_EQ(again.document.stop, StopReason::separated);
  ASSERT_EQ(again.fragments.size(), 2u);
  EXPECT_GT(again.fragments[1].volume, 0.1);
  double nearest = 1;
  for (const Vec3& x : again.crack.positions)
    nearest = std::min(nearest, (x - Vec3(-0.2, 0.03, 0.25)).norm());
  EXPECT_LT(nearest, 0.03) << "it passes where the crack was";
}

// Rows of another scene are never taken for one's own, whatever the text says.
TEST(RunIdentity, TellsScenesApartThatWereBuiltInCode) {
  Scene scene = layered_cube();
  scene.text.clear();
  const auto identity = [](const Scene& s) {
    const PreparedBody body = prepare(s);
    return run_identity(s, body, load_of(s, body), {});
  };
  const std::string original = identity(scene);
  EXPECT_EQ(identity(scene), original);
  const auto changed = [&](auto change) {
    Scene other = scene;
    change(other);
    return identity(other);
  };
  EXPECT_NE(changed([](Scene& s) { s.material.poisson_ratio = 0.25; }), original);
  EXPECT_NE(changed([](Scene& s) {
              s.boundary[0].value *= 2;
              s.boundary[1].value *= 2;
            }),
            original);
  EXPECT_NE(changed([](Scene& s) { s.run.contact = false; }), original);
  EXPECT_NE(changed([](Scene& s) { s.run.quadrature_tolerance = 1e-5; }), original);
  EXPECT_NE(changed([](Scene& s) { s.resolution.crack = 0.11; }), original);
  EXPECT_NE(changed([](Scene& s) { std::get<Layers>(s.material.toughness_field[0].kind).wavelength = 0.2; }),
            original);
  EXPECT_EQ(changed([](Scene& s) { s.run.frames = 3; }), original) << "a run may go on from its frame limit";
}

}  // namespace conchoid
