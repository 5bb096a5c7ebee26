#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/study/surface_distance.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// The same body under a map of space and units breaks the same way.
namespace conchoid {
namespace {

struct Map {
  Mat3 turn = Mat3::Identity();  ///< rotation or mirror image
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  double stiffness = 1;

  Vec3 operator()(const Vec3& x) const { return scale * (turn * x) + shift; }
  bool mirrors() const { return turn.determinant() < 0; }
};

TriMesh mapped(TriMesh mesh, const Map& map) {
  for (Vec3& x : mesh.positions)
    x = map(x);
  if (map.mirrors())
    for (auto& c : mesh.corners)
      std::swap(c[1], c[2]);
  return mesh;
}

// The cube as a mesh file, pulled at an angle, and everything that has a length or a stress mapped.
RunResult run(const Map& map, const Vec3& pull, const std::string& run_keys = {}) {
  const test::TemporaryFolder folder;
  const std::string file = test::write_mesh_in(folder, "body.obj", mapped(built_in_model("cube").mesh, map));
  const Vec3 up = map.turn * Vec3::UnitZ(), traction = map.stiffness * (map.turn * pull);
  const double near = 0.49 * map.scale, k = map.stiffness;
  const std::string text =
      test::mesh_body_text(file) +
      test::material_text(
          {.E = 3.1e9 * k, .strength = 7.6e7 * k, .toughness = 1e6 * k * std::sqrt(map.scale)}) +
      test::resolution_text(0.1 * map.scale, 0.02 * map.scale) +
      test::region_text("top", test::half_space_text(up, up.dot(map.shift) + near)) +
      test::region_text("bottom", test::half_space_text(-up, -up.dot(map.shift) + near)) +
      test::boundary_text("top", "traction", traction) +
      test::boundary_text("bottom", "traction", -traction) + "[run]\ninertia_relief = true\n" + run_keys;
  return test::run_text(text);
}

struct Case {
  const char* name;
  Vec3 pull;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class Invariance : public testing::TestWithParam<Case> {
 protected:
  void expect_same_bits(double size, double stiffness);

  void expect_same(const Map& map) {
    const RunResult here = run({}, GetParam().pull), there = run(map, GetParam().pull);
    EXPECT_EQ(here.document.stop, StopReason::separated);
    EXPECT_EQ(here.document.stop, there.document.stop);
    // Pieces are meshed anew, and round-off may let what is left of a crack in one move a hair.
    const std::string first = "after_separation = 'stop'\n";
    EXPECT_EQ(run({}, GetParam().pull, first).document.frames,
              run(map, GetParam().pull, first).document.frames);
    EXPECT_EQ(here.cracks, there.cracks);
    const double diagonal = map.scale * std::sqrt(3.0);
    const double apart = symmetric_distance(mapped(here.crack, map), there.crack, 5000).mean / diagonal;
    EXPECT_LT(apart, 1e-3);
    RecordProperty("apart", test::text(apart));
    const double volume = std::pow(map.scale, 3);
    ASSERT_EQ(here.fragments.size(), there.fragments.size());
    for (std::size_t i = 0; i < here.fragments.size(); ++i) {
      EXPECT_NEAR(there.fragments[i].volume / volume, here.fragments[i].volume, 1e-3);
      RecordProperty(fmt::format("volume_{}", i),
                     test::text(there.fragments[i].volume / volume - here.fragments[i].volume));
    }
  }
};

TEST_P(Invariance, Rotated) {
  expect_same({.turn = test::arbitrary_rotation()});
}

TEST_P(Invariance, Mirrored) {
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = -1;
  expect_same({.turn = mirror});
}

TEST_P(Invariance, MirroredInAnObliquePlane) {
  const Vec3 n = Vec3(0.3, -0.7, 0.5).normalized();
  expect_same({.turn = Mat3::Identity() - 2 * n * n.transpose()});
}

TEST_P(Invariance, MovedTenThousandBodyLengths) {
  expect_same({.shift = 1e4 * Vec3(0.6, -0.48, 0.64)});
}

TEST_P(Invariance, PhysicallyScaled) {
  expect_same({.scale = 100, .stiffness = 1000});
}

TEST_P(Invariance, PhysicallyScaledDown) {
  expect_same({.scale = 1e-3, .stiffness = 0.01});
}

void Invariance::expect_same_bits(double size, double stiffness) {
  const Map map{.scale = size, .stiffness = stiffness};
  const double K = stiffness * std::sqrt(size), volume = size * size * size;
  const RunResult here = run({}, GetParam().pull), there = run(map, GetParam().pull);
  EXPECT_EQ(here.document.frames, there.document.frames);
  ASSERT_EQ(here.crack.node_count(), there.crack.node_count());
  ASSERT_EQ(here.crack.corners.size(), there.crack.corners.size());
  for (std::size_t i = 0; i < here.crack.node_count(); ++i)
    ASSERT_EQ(there.crack.positions[NodeId(i)], size * here.crack.positions[NodeId(i)]);
  for (std::size_t t = 0; t < here.crack.triangle_count(); ++t)
    ASSERT_EQ(there.crack.corners[TriId(t)], here.crack.corners[TriId(t)]);
  ASSERT_EQ(here.front.size(), there.front.size());
  for (std::size_t i = 0; i < here.front.size(); ++i)
    ASSERT_EQ(there.front[i].intensity, K * here.front[i].intensity);
  ASSERT_EQ(here.fragments.size(), there.fragments.size());
  for (std::size_t i = 0; i < here.fragments.size(); ++i)
    EXPECT_EQ(there.fragments[i].volume, volume * here.fragments[i].volume);
}

TEST_P(Invariance, ScaledByPowersOfTwoBitForBit) {
  expect_same_bits(4, 16);
}

TEST_P(Invariance, StiffenedByAnOddPowerOfTwoBitForBit) {
  expect_same_bits(1, 8);
}

TEST_P(Invariance, ShrunkAndSoftenedByPowersOfTwoBitForBit) {
  expect_same_bits(0.25, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Cubes, Invariance,
                         testing::Values(Case{"straight", Vec3(0, 0, 1e8)},
                                         Case{"slanted", Vec3(3.3e7, 1.7e7, 9.1e7)},
                                         Case{"fortyfive", Vec3(0.7e8, 0, 0.7e8)}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace conchoid
