#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/sim/run.hpp"
#include "hollow_bodies.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// Bodies with several cracks, and bodies with holes, in tension: they come apart.
namespace conchoid {
namespace {

std::string glass() {
  return test::material_text({.E = 7e10, .nu = 0.22, .strength = 4.5e7, .toughness = 7.5e5});
}

double area(const RunResult& result) {
  return surface_area(result.crack);
}

void expect_pieces(const RunResult& result, std::size_t least) {
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_GE(result.fragments.size(), least);
  double volume = 0;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight);
    volume += f.volume;
  }
  EXPECT_NEAR(volume, result.document.body_volume, 1e-9 * result.document.body_volume);
}

class SeveralCracks : public testing::TestWithParam<int> {};

TEST_P(SeveralCracks, PartThePulledCube) {
  const RunResult result = test::run_text(
      "[body]\nmodel = 'cube'\n" + glass() + test::boundary_text("z+", "traction", {0, 0, 6e7}) +
      "[[boundary]]\nregion = 'z-'\nfixed = true\n[resolution]\nsurface = 0.02\n" +
      fmt::format("[run]\nafter_separation = 'stop'\nframes = 20\nmax_cracks = {}\n", GetParam()));
  expect_pieces(result, 2);
  EXPECT_LT(area(result), GetParam() + 1);
}

RunResult pulled_bar(const std::string& run_keys) {
  const test::TemporaryFolder folder;
  const TriMesh bar = box_mesh({0.02, 0.02, 0.1}, 4, 4, 20);
  const Box box = bounding_box(bar);
  const double e = 1e-4;
  return test::run_text(test::mesh_body_text(test::write_mesh_in(folder, "bar.obj", bar)) + glass() +
                        test::resolution_text(0.004, 0.0005) +
                        test::region_text("low", test::half_space_text(-Vec3::UnitZ(), -box.low.z() - e)) +
                        test::region_text("high", test::half_space_text(Vec3::UnitZ(), box.high.z() - e)) +
                        test::boundary_text("high", "traction", {0, 0, 6e7}) +
                        "[[boundary]]\nregion = 'low'\nfixed = true\n[run]\nframes = 30\n" + run_keys);
}

TEST_P(SeveralCracks, PartThePulledBar) {
  const RunResult result =
      pulled_bar(fmt::format("after_separation = 'stop'\nmax_cracks = {}\n", GetParam()));
  expect_pieces(result, 2);
  EXPECT_LT(area(result), (GetParam() + 1) * 0.02 * 0.02);
}

INSTANTIATE_TEST_SUITE_P(Cracks, SeveralCracks, testing::Values(2, 3, 5));

// A crack that ends in the piece touches itself at a point there.
TEST(PulledBar, GoesOnInItsPieces) {
  const RunResult result = pulled_bar("max_cracks = 3\n");
  expect_pieces(result, 2);
  for (const std::string& warning : result.document.warnings)
    EXPECT_EQ(warning.find("cannot be computed"), std::string::npos) << warning;
}

TEST(OverloadedCube, BreaksAcross) {
  const test::TemporaryFolder folder;
  const RunResult result = test::run_text(
      test::mesh_body_text(test::write_mesh_in(folder, "cube.obj", box_mesh({0.05, 0.05, 0.05}, 8, 8, 8))) +
      "[material]\nname = 'ceramic'\n" +
      test::region_text("top", test::half_space_text(Vec3::UnitZ(), 0.0249)) +
      test::region_text("bottom", test::half_space_text(-Vec3::UnitZ(), 0.0249)) +
      test::boundary_text("top", "traction", {0, 0, 1e9}) +
      "[[boundary]]\nregion = 'bottom'\nfixed = true\n[run]\nmax_cracks = 3\n");
  expect_pieces(result, 2);
  EXPECT_LT(area(result), 4 * 0.05 * 0.05);
  double fracture = 0;  // of the largest piece
  const Fragment& rest = result.fragments.front();
  for (std::size_t t = 0; t < rest.mesh.triangle_count(); ++t)
    if (rest.face_kind[t] == FaceKind::fracture) fracture += area_vector(rest.mesh, TriId(t)).norm();
  EXPECT_GT(fracture, 0.75 * 0.05 * 0.05);
}

struct Hollow {
  const char* name;
  TriMesh mesh;
  Vec3 crack;  ///< middle of the first crack, a rectangle across the wall
  double width;
  double crack_edge;
  double off;  ///< × crack_edge, of the crack from its plane at most
};

void PrintTo(const Hollow& body, std::ostream* out) {
  *out << body.name;
}

class HollowBodies : public testing::TestWithParam<Hollow> {};

// The crack goes round the hole and meets itself.
TEST_P(HollowBodies, PartInThePlaneOfTheirCrack) {
  const Hollow& body = GetParam();
  const test::TemporaryFolder folder;
  const Box box = bounding_box(body.mesh);
  const double e = 1e-6 * box.diagonal();
  const RunResult result = test::run_text(
      test::mesh_body_text(test::write_mesh_in(folder, "body.obj", body.mesh)) +
      test::material_text({.toughness = 1e4}) + test::resolution_text(body.crack_edge, body.crack_edge / 6) +
      test::region_text("low", test::half_space_text(-Vec3::UnitZ(), -box.low.z() - e)) +
      test::region_text("high", test::half_space_text(Vec3::UnitZ(), box.high.z() - e)) +
      test::boundary_text("high", "traction", {0, 0, 1e6}) + "[[boundary]]\nregion = 'low'\nfixed = true\n" +
      fmt::format("[[crack]]\nkind = 'rectangle'\ncenter = {}\nedges = [[{}, 0, 0], [0, {}, 0]]\n",
                  test::text(body.crack), body.width, 0.8) +
      "[run]\nframes = 60\nmax_cracks = 0\n");
  expect_pieces(result, 2);
  EXPECT_EQ(result.fragments.size(), 2u);
  double off = 0;
  for (const Vec3& x : result.crack.positions)
    off = std::max(off, std::abs(x.z() - body.crack.z()));
  RecordProperty("off", test::text(off / body.crack_edge));
  EXPECT_LT(off, body.off * body.crack_edge);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, HollowBodies,
    testing::Values(Hollow{"Tube", shapes::tube(1, 0.6, 4, 9), {1, 0, 0.03}, 1, 0.2, 0.4},
                    Hollow{"ThinnerTube", shapes::tube(1, 0.7, 4, 9), {1, 0, 0.03}, 1, 0.16, 0.25},
                    Hollow{"ThickTube", shapes::tube(1, 0.4, 4, 9), {1, 0, 0.05}, 1, 0.22, 0.2},
                    Hollow{"TubeOfThreeRows", shapes::tube(1, 0.6, 4, 9), {1, 0, 0.03}, 1, 0.14, 0.15},
                    Hollow{"Cavity", shapes::block_with_cavity(8, 1, 5), {4, 0, 0}, 1.5, 0.5, 1},
                    Hollow{"Cup", shapes::cup(), {1, 0, 0.31}, 1, 0.2, 0.25}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace conchoid
