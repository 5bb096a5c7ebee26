#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/run.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

std::string cube_text(double slope_degrees, double traction) {
  const double a = slope_degrees * std::numbers::pi / 180;
  const Vec3 t = traction * Vec3(std::sin(a), 0, std::cos(a));
  return "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
         test::boundary_text("z+", "traction", t) + test::boundary_text("z-", "traction", -t) +
         "[run]\ninertia_relief = true\n";
}

// Normal of the crack where it started: of the plane through the front of the first frame.
Vec3 start_normal(const RunResult& result) {
  std::vector<Vec3> ring;
  for (const FrontRow& row : result.front)
    if (row.frame == 1 && row.front == 0) ring.push_back(row.position);
  Vec3 center = Vec3::Zero(), area = Vec3::Zero();
  for (const Vec3& x : ring)
    center += x / static_cast<double>(ring.size());
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)
    area += cross(ring[i] - center, ring[i + 1] - center);
  return area.normalized();
}

class PulledCubeAt : public testing::TestWithParam<double> {};

TEST_P(PulledCubeAt, OneCrackSeparatesItIntoTwoPieces) {
  const RunResult result = test::run_text(cube_text(GetParam(), 1e8));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_EQ(result.cracks, 1);
  ASSERT_EQ(result.fragments.size(), 2u);
  double volume = 0;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight);
    EXPECT_NEAR(f.volume, enclosed_volume(f.mesh), 1e-6);  // slits are drawn apart
    EXPECT_TRUE(std::count(f.face_kind.begin(), f.face_kind.end(), FaceKind::fracture) > 0);
    volume += f.volume;
  }
  EXPECT_NEAR(volume, 1, 1e-9);
  // Area of the crack: at least that of the smallest cut that could make this piece.
  EXPECT_GT(surface_area(result.crack), 0.1);
  const double slope = GetParam() * std::numbers::pi / 180;
  const double along_pull = std::abs(start_normal(result).dot(Vec3(std::sin(slope), 0, std::cos(slope))));
  if (GetParam() == 0) {
    EXPECT_GT(along_pull, std::cos(10 * std::numbers::pi / 180));
    EXPECT_NEAR(surface_area(result.crack), 1, 0.06);  // all but flat and across: 0.02 at half the crack edge
  }
  RecordProperty("degrees_to_pull", test::text(std::acos(along_pull) * 180 / std::numbers::pi));
  RecordProperty("smaller", test::text(result.fragments[1].volume));
}

INSTANTIATE_TEST_SUITE_P(Slopes, PulledCubeAt, testing::Values(0.0, 45.0));

// A pair of forces at 45° has a moment and leaves two faces free, so no stress in the cube points along the
// pull. Tractions σ·n of a uniaxial stress on all four faces do that: the crack starts across the pull.
TEST(PulledCube, UniaxialStressAtFortyFiveDegreesStartsACrackAcrossIt) {
  const Vec3 t(5e7, 0, 5e7);
  const RunResult result =
      test::run_text("[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
                     test::boundary_text("z+", "traction", t) + test::boundary_text("z-", "traction", -t) +
                     test::boundary_text("x+", "traction", t) + test::boundary_text("x-", "traction", -t));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_EQ(result.cracks, 1);
  ASSERT_GE(result.fragments.size(), 2u);
  double volume = 0;
  for (const Fragment& f : result.fragments)
    volume += f.volume;
  EXPECT_NEAR(volume, 1, 1e-9);
  EXPECT_GT(result.fragments[0].volume + result.fragments[1].volume, 0.99);
  const double along_pull = std::abs(start_normal(result).dot(Vec3(1, 0, 1).normalized()));
  EXPECT_GT(along_pull, std::cos(10 * std::numbers::pi / 180));
  RecordProperty("degrees_to_pull",
                 test::text(std::acos(std::min(1.0, along_pull)) * 180 / std::numbers::pi));
}

TEST(WeakLoad, LeavesTheCubeIntact) {
  const RunResult result = test::run_text(cube_text(0, 5e7));
  EXPECT_EQ(result.document.stop, StopReason::intact);
  EXPECT_EQ(result.cracks, 0);
  EXPECT_EQ(result.document.frames, 0);
  ASSERT_EQ(result.fragments.size(), 1u);
  EXPECT_NEAR(result.fragments[0].volume, 1, 1e-12);
  EXPECT_EQ(result.crack.triangle_count(), 0u);
}

std::string disc_text(const Mat3& stress, int frames) {
  return "[body]\nmodel = 'infinite'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
         "[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.5\n" +
         test::remote_stress_text(stress) + fmt::format("[run]\nframes = {}\n", frames);
}

Mat3 tension(double s) {
  return Vec3(0, 0, s).asDiagonal();
}

TEST(Disc, BelowTheToughnessStaysAsItIs) {
  // K_I = 2σ√(a/π) = 0.8 K_c
  const RunResult result = test::run_text(disc_text(tension(1e6), 10));
  EXPECT_EQ(result.document.stop, StopReason::arrested);
  EXPECT_EQ(result.document.frames, 1);
  EXPECT_EQ(result.largest_growth, 0);
  for (const FrontRow& row : result.front)
    EXPECT_EQ(row.speed, 0);
}

TEST(Disc, UnderTensionStaysAFlatDisc) {
  const RunResult result = test::run_text(disc_text(tension(2e6), 6));
  EXPECT_EQ(result.document.stop, StopReason::frame_limit);
  double height = 0;
  for (const Vec3& x : result.crack.positions)
    height = std::max(height, std::abs(x.z()));
  double least = 1e9, most = 0;
  for (const FrontRow& row : result.front)
    if (row.frame == result.document.frames) {
      const double radius = std::hypot(row.position.x(), row.position.y());
      least = std::min(least, radius);
      most = std::max(most, radius);
    }
  EXPECT_GT(least, 0.6);
  EXPECT_LT(most - least, 0.05 * most);
  EXPECT_LT(height, 0.02 * most);
  RecordProperty("least", test::text(least));
  RecordProperty("most", test::text(most));
  RecordProperty("height", test::text(height));
}

TEST(Disc, UnderShearKinksBySeventyDegreesWhereModeTwoIsPure) {
  Mat3 shear = Mat3::Zero();
  shear(0, 2) = shear(2, 0) = 3e6;
  const RunResult result = test::run_text(disc_text(shear, 2));
  int count = 0;
  double farthest = 0;
  for (const FrontRow& row : result.front) {
    if (row.frame != 1 || std::abs(row.position.y()) > 1e-6) continue;
    const double degrees = std::abs(row.kink_angle) * 180 / std::numbers::pi;
    EXPECT_NEAR(degrees, 70.53, 2);
    farthest = std::max(farthest, std::abs(degrees - 70.53));
    EXPECT_LT(row.kink_angle * row.intensity[1], 0);  // positive K_II turns the front down
    ++count;
  }
  EXPECT_EQ(count, 2);
  RecordProperty("farthest", test::text(farthest));
}

std::string edge_cube_text(const Vec3& traction, double resolution) {
  return "[body]\nmodel = 'edge-crack-cube'\n" + test::material_text() +
         test::resolution_text(resolution, 0.02) + test::boundary_text("z+", "traction", traction) +
         test::boundary_text("z-", "traction", -traction) + "[run]\nmax_cracks = 0\ninertia_relief = true\n";
}

double largest_height(const TriMesh& crack) {
  double height = 0;
  for (const Vec3& x : crack.positions)
    height = std::max(height, std::abs(x.z()));
  return height;
}

class EdgeCrackCube : public testing::TestWithParam<double> {};

TEST_P(EdgeCrackCube, OpeningModeGrowsStraightAheadThroughTheCube) {
  const RunResult result = test::run_text(edge_cube_text({0, 0, 2e6}, GetParam()));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_EQ(result.fragments.size(), 2u);
  EXPECT_LT(largest_height(result.crack), 0.05);
  EXPECT_NEAR(result.fragments[0].volume, 0.5, 0.01);
  RecordProperty("height", test::text(largest_height(result.crack)));
  RecordProperty("volume", test::text(result.fragments[0].volume));
}

// The angle of pure mode II along the middle of the front.
TEST(EdgeCrack, SlidingModeTurnsAwayFromThePlane) {
  const RunResult result = test::run_text(edge_cube_text({1.2e7, 0, 0}, 0.1));
  int count = 0;
  for (const FrontRow& row : result.front)
    if (row.frame == 1 && std::abs(row.position.y()) < 0.2) {
      EXPECT_NEAR(std::abs(row.kink_angle) * 180 / std::numbers::pi, 70.5, 3) << row.position.transpose();
      ++count;
    }
  EXPECT_GE(count, 3);
  EXPECT_GT(largest_height(result.crack), 0.05);
  RecordProperty("height", test::text(largest_height(result.crack)));
}

TEST(EdgeCrack, SlidingModeGrowsOn) {
  const RunResult result = test::run_text(edge_cube_text({1.2e7, 0, 0}, 0.1));
  EXPECT_GT(result.largest_growth, 0.3);
}

// The classic of torn chalk: in the middle of the front K_II vanishes and the crack goes straight on, towards
// the ends it turns up on one side and down on the other; half a turn about the x axis changes nothing.
TEST(EdgeCrack, TearingModeTwistsTheSurfaceAndSplitsTheCubeInHalves) {
  const RunResult result = test::run_text(edge_cube_text({0, 3e6, 0}, 0.1));
  int middle = 0, ends = 0;
  for (const FrontRow& row : result.front) {
    if (row.frame != 1) continue;
    EXPECT_LT(std::abs(row.intensity[0]), 0.02 * std::abs(row.intensity[2]));
    if (std::abs(row.position.y()) < 0.01) {
      EXPECT_LT(std::abs(row.kink_angle), 0.02);
      ++middle;
    }
    if (std::abs(row.position.y()) > 0.4) {
      EXPECT_GT(-row.kink_angle * row.position.y(), 0.1);
      ++ends;
    }
  }
  EXPECT_EQ(middle, 1);
  EXPECT_EQ(ends, 2);
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_GE(result.fragments.size(), 2u);
  EXPECT_GT(result.fragments[0].volume + result.fragments[1].volume, 0.999);
  EXPECT_NEAR(result.fragments[0].volume, 0.5, 0.02);
  EXPECT_GT(largest_height(result.crack), 0.4);
  RecordProperty("height", test::text(largest_height(result.crack)));
  RecordProperty("volume", test::text(result.fragments[0].volume));
}

INSTANTIATE_TEST_SUITE_P(Resolutions, EdgeCrackCube, testing::Values(0.05, 0.08, 0.1));

// A penny crack pressed three times and a bit as hard as it would bear pulled.
TEST(Compression, DrivesACrackOnlyAsPublishedAndOnlyBeyondTheFactor) {
  const double K = 2 * 1e6 * std::sqrt(0.5 / std::numbers::pi);
  const auto grown = [&](double factor, const std::string& run_keys) {
    Mat3 remote = Mat3::Zero();
    remote(2, 2) = -1e6;
    return test::run_text(
               "[body]\nmodel = 'infinite'\n" + test::material_text({.toughness = K / 3.5}) +
               fmt::format("compressive_factor = {}\n", factor) + test::resolution_text(0.1, 0.05) +
               "[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.5\ntriangles = "
               "384\n" +
               test::remote_stress_text(remote) + "[run]\nframes = 2\nmax_cracks = 0\n" + run_keys)
        .largest_growth;
  };
  EXPECT_EQ(grown(3, ""), 0);
  EXPECT_EQ(grown(3, "contact = false\n"), 0);
  EXPECT_GT(grown(3, "contact = false\ncompression = 'published'\n"), 0.02);
  EXPECT_EQ(grown(4, "contact = false\ncompression = 'published'\n"), 0);
  EXPECT_THROW(grown(3, "compression = 'published'\n"), InputError);
}

// A penny crack that does not grow itself, in a body pulled four times as hard along it: its faces see
// 4σ − (1+2ν)/2 σ, tear across, and the branch joins the face it came from and grows on one side of it.
std::string branch_text(double strength, int cracks, int frames) {
  Mat3 remote = Mat3::Zero();
  remote.diagonal() << 4e6, 0, 1e6;
  return "[body]\nmodel = 'infinite'\n" + test::material_text({.strength = strength, .toughness = 1e6}) +
         test::resolution_text(0.1, 0.02) +
         "[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.5\ntriangles = 384\n" +
         test::remote_stress_text(remote) +
         fmt::format("[run]\nframes = {}\nmax_cracks = {}\n", frames, cracks);
}

TEST(Branch, StartsOnTheFaceOfACrackWhereItIsTooWeak) {
  const RunResult result = test::run_text(branch_text(3e6, 1, 5));
  EXPECT_EQ(result.cracks, 2);
  const TriMesh& crack = result.crack;
  const std::vector<int> part = connected_parts(crack);
  double reach = 0, low = 1, high = -1, area = 0, across = 0;
  for (std::size_t n = 0; n < crack.node_count(); ++n) {
    if (part[n] == 0) continue;
    const Vec3& x = crack.positions[NodeId(n)];
    reach = std::max(reach, std::abs(x.y()));
    // side of the face it started from: within the first disc's reach of the parent's middle
    if (x.head<2>().norm() < 0.3) {
      low = std::min(low, x.z());
      high = std::max(high, x.z());
    }
  }
  const double side = high > -low ? 1 : -1;
  EXPECT_GT(std::max(high, -low), 0.2);
  EXPECT_GE(-side * (side > 0 ? low : high), 0) << "does not reach its crack";
  EXPECT_LT(-side * (side > 0 ? low : high), 0.03) << "goes through its crack";
  EXPECT_GT(reach, 0.25);
  for (std::size_t t = 0; t < crack.triangle_count(); ++t)
    if (part[crack.corners[TriId(t)][0].index()] == 1) {
      area += area_vector(crack, TriId(t)).norm();
      across += std::abs(area_vector(crack, TriId(t)).x());
    }
  EXPECT_GT(across, 0.9 * area);
}

TEST(Branch, OnlyBeyondTheStrengthAndIfCracksMayStart) {
  EXPECT_EQ(test::run_text(branch_text(3.5e6, 1, 2)).cracks, 1);
  EXPECT_EQ(test::run_text(branch_text(3e6, 0, 2)).cracks, 1);
}

}  // namespace
}  // namespace conchoid
