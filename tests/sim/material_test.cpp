#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "conchoid/core/context.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/study/surface_distance.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// Crack surfaces follow the structure of the material.
namespace conchoid {
namespace {

constexpr double kCrackEdge = 0.1;

std::string cube_text(const std::string& fields, double surface = 0.02) {
  return test::cracked_cube_text(fields, kCrackEdge, surface);
}

std::string noise_text(double wavelength, double amplitude, int octaves = 1) {
  return fmt::format(
      "[material.toughness_field]\nkind = 'noise'\nwavelength = {}\namplitude = {}\noctaves = {}\n",
      wavelength, amplitude, octaves);
}
std::string layers_text(const Vec3& direction, double wavelength, double amplitude) {
  return fmt::format(
      "[material.toughness_field]\nkind = 'layers'\ndirection = {}\nwavelength = {}\namplitude = {}\n",
      test::text(direction), wavelength, amplitude);
}

/// Standard deviation of the height over the best plane [m].
double roughness(const TriMesh& mesh) {
  double area = 0;
  Vec3 center = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double a = area_vector(mesh, TriId(t)).norm();
    area += a;
    center += a * centroid(mesh, TriId(t));
  }
  center /= area;
  Mat3 spread = Mat3::Zero();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 d = centroid(mesh, TriId(t)) - center;
    spread += area_vector(mesh, TriId(t)).norm() / area * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[0]));
}

TEST(Material, AHomogeneousCrackIsSmooth) {
  const RunResult result = test::run_text(cube_text(""));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  const double height = roughness(result.crack);
  EXPECT_LT(height, 0.1 * kCrackEdge);
  RecordProperty("height", test::text(height));
}

TEST(Material, AFieldWithoutAmplitudeChangesNothing) {
  EXPECT_EQ(test::run_text(cube_text(layers_text({0.3, 0, 1}, 0.2, 0))).document.hash,
            test::run_text(cube_text("")).document.hash);
}

TEST(Material, RoughnessGrowsWithTheAmplitude) {
  double before = roughness(test::run_text(cube_text("")).crack);
  for (double amplitude : {0.1, 0.2, 0.4}) {
    const RunResult result = test::run_text(cube_text(noise_text(0.2, amplitude)));
    EXPECT_EQ(result.document.stop, StopReason::separated);
    EXPECT_EQ(result.fragments.size(), 2u);
    const double height = roughness(result.crack);
    EXPECT_GT(height, 1.3 * before) << amplitude;
    RecordProperty(fmt::format("height_{}", amplitude), test::text(height));
    before = height;
  }
}

/// Height z of the crack over a square grid in the middle of the cube, by the nearest node.
std::vector<std::vector<double>> heights(const TriMesh& crack, int count) {
  std::vector<std::vector<double>> rows(count, std::vector<double>(count));
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const Vec2 at(0.9 * ((i + 0.5) / count - 0.5), 0.9 * ((j + 0.5) / count - 0.5));
      double nearest = 1;
      for (const Vec3& x : crack.positions)
        if (const double d = (x.head<2>() - at).squaredNorm(); d < nearest) {
          nearest = d;
          rows[i][j] = x.z();
        }
    }
  return rows;
}

/// Wavelength that half of the slope's power lies above and half below: spectra of the rows, Hann window.
double middle_wavelength(const TriMesh& crack) {
  constexpr int kCount = 64;
  const auto rows = heights(crack, kCount);
  std::vector<double> power(kCount / 2, 0.0);
  for (const auto& row : rows)
    for (int k = 1; k < kCount / 2; ++k) {
      double re = 0, im = 0;
      for (int j = 1; j < kCount; ++j) {
        const double phase = 2 * std::numbers::pi * j / kCount, window = 1 - std::cos(phase);
        re += window * (row[j] - row[j - 1]) * std::cos(k * phase);
        im += window * (row[j] - row[j - 1]) * std::sin(k * phase);
      }
      power[k] += re * re + im * im;
    }
  double total = 0, sum = 0;
  for (double p : power)
    total += p;
  for (int k = 1; k < kCount / 2; ++k) {
    if (sum + power[k] >= 0.5 * total) return 0.9 / (k - 0.5 + (0.5 * total - sum) / power[k]);
    sum += power[k];
  }
  return 0;
}

TEST(Material, TheSpectrumFollowsTheWavelengthOfTheField) {
  double before = 0;
  for (double wavelength : {0.08, 0.16, 0.32}) {
    const RunResult result = test::run_text(cube_text(noise_text(wavelength, 0.2)));
    EXPECT_EQ(result.document.stop, StopReason::separated);
    const double found = middle_wavelength(result.crack);
    EXPECT_GT(found, 1.2 * before) << wavelength;
    EXPECT_GT(found, 0.6 * wavelength);
    EXPECT_LT(found, 1.7 * wavelength);
    RecordProperty(fmt::format("wavelength_{}", wavelength), test::text(found));
    before = found;
  }
}

// Bedding tilted by 15°: the crack leaves the plane that the load asks for and runs along the weak layers.
TEST(Material, TheCrackRunsAlongWeakLayers) {
  const Vec3 across = Vec3(std::sin(0.26), 0, std::cos(0.26));
  const RunResult result = test::run_text(cube_text(layers_text(across, 0.2, 0.4)));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_EQ(result.fragments.size(), 2u);
  const Layers layers{across, 0.2, 0.4, 0};
  const auto mean_toughness = [&](const TriMesh& crack) {
    double area = 0, sum = 0;
    for (std::size_t t = 0; t < crack.triangle_count(); ++t) {
      const double a = area_vector(crack, TriId(t)).norm();
      area += a;
      sum += a * layers.at(centroid(crack, TriId(t))).value;
    }
    return sum / area;
  };
  const double along = mean_toughness(result.crack),
               straight = mean_toughness(test::run_text(cube_text("")).crack);
  EXPECT_NEAR(straight, 1, 0.05);
  EXPECT_LT(along, 0.9);
  RecordProperty("toughness", test::text(along));
}

// Grain boundaries are met more often by the crack than by a plane.
TEST(Material, TheCrackPrefersGrainBoundaries) {
  const std::string text = "[material.toughness_field]\nkind = 'grains'\nsize = 0.25\nweakening = 0.6\n";
  const RunResult result = test::run_text(cube_text(text));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_EQ(result.fragments.size(), 2u);
  const Grains grains{.size = 0.25, .width = 0.05, .weakening = 0.6};
  double area = 0, sum = 0;
  for (std::size_t t = 0; t < result.crack.triangle_count(); ++t) {
    const double a = area_vector(result.crack, TriId(t)).norm();
    area += a;
    sum += a * grains.at(centroid(result.crack, TriId(t))).value;
  }
  double anywhere = 0;
  constexpr int kPoints = 40;
  for (int i = 0; i < kPoints; ++i)
    for (int j = 0; j < kPoints; ++j)
      anywhere += grains.at(Vec3((i + 0.5) / kPoints - 0.5, (j + 0.5) / kPoints - 0.5, 0)).value /
                  (kPoints * kPoints);
  EXPECT_LT(sum / area, anywhere - 0.03);
  RecordProperty("on_the_crack", test::text(sum / area));
  RecordProperty("in_a_plane", test::text(anywhere));
}

TEST(Material, ACrackStartsWhereTheBodyIsWeak) {
  // One weak layer across the pulled cube: x-normal faces crack there, whatever the mesh prefers.
  const std::string text =
      "[body]\nmodel = 'cube'\n" + test::material_text() +
      "[material.strength_field]\nkind = 'layers'\ndirection = [0.0, 0.0, 1.0]\nwavelength = 1.0\n"
      "amplitude = 0.5\nphase = -0.5\n" +  // weakest at z = 0.25
      test::resolution_text(kCrackEdge, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 6e7}) +
      test::boundary_text("z-", "traction", {0, 0, -6e7}) + "[run]\nframes = 1\n";
  const RunResult result = test::run_text(text);
  EXPECT_EQ(result.cracks, 1);
  double height = 0;
  for (const Vec3& x : result.crack.positions)
    height += x.z() / static_cast<double>(result.crack.node_count());
  EXPECT_NEAR(height, 0.25, 0.08);
}

TEST(Material, TheSameBitsForOneThreadAndForTwo) {
  const std::string text = cube_text(noise_text(0.2, 0.3, 3));
  const RunResult one = ExecutionContext(1).run([&] { return test::run_text(text); });
  const RunResult two = ExecutionContext(2).run([&] { return test::run_text(text); });
  EXPECT_EQ(one.document.hash, two.document.hash);
}

/// The cube as a mesh file under a rotation and a scale, with a field that turns and grows with it.
RunResult run_mapped(const Mat3& turn, double scale) {
  TriMesh body = built_in_model("cube").mesh;
  for (Vec3& x : body.positions)
    x = scale * (turn * x);
  const test::TemporaryFolder folder;
  const std::string file = test::write_mesh_in(folder, "body.obj", body);
  const Vec3 up = turn * Vec3::UnitZ();
  const std::string axes = fmt::format("axes = [{}, {}, {}]\n", test::text(Vec3(turn.col(0))),
                                       test::text(Vec3(turn.col(1))), test::text(Vec3(turn.col(2))));
  const std::string text =
      test::mesh_body_text(file) + test::material_text({.toughness = 1e6 * std::sqrt(scale)}) +
      fmt::format(
          "[[material.toughness_field]]\nkind = 'noise'\nwavelength = {}\namplitude = 0.2\noctaves = "
          "2\n{}[[material.toughness_field]]\nkind = 'grains'\nsize = {}\nweakening = 0.3\n{}",
          0.3 * scale, axes, 0.4 * scale, axes) +
      test::resolution_text(kCrackEdge * scale, 0.02 * scale) +
      test::region_text("top", test::half_space_text(up, 0.49 * scale)) +
      test::region_text("bottom", test::half_space_text(-up, 0.49 * scale)) +
      fmt::format(
          "[[crack]]\nkind = 'disc'\ncenter = [0.0, 0.0, 0.0]\nnormal = {}\ndirection = {}\nradius = {}\n",
          test::text(up), test::text(Vec3(turn.col(0))), 0.2 * scale) +
      test::boundary_text("top", "traction", 1e7 * up) +
      test::boundary_text("bottom", "traction", -1e7 * up) + "[run]\nmax_cracks = 0\n";
  RunResult result = test::run_text(text);
  for (Vec3& x : result.crack.positions)
    x = turn.transpose() * x / scale;
  return result;
}

void expect_same_fracture(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.document.stop, StopReason::separated);
  EXPECT_EQ(a.document.stop, b.document.stop);
  EXPECT_EQ(a.document.frames, b.document.frames);
  EXPECT_EQ(a.fragments.size(), b.fragments.size());
  EXPECT_LT(symmetric_distance(a.crack, b.crack, 5000).mean, 1e-3 * std::sqrt(3.0));
  EXPECT_GT(roughness(a.crack), 0.005);  // the field was felt
}

TEST(Material, TurningTheBodyTurnsTheFracture) {
  expect_same_fracture(run_mapped(Mat3::Identity(), 1), run_mapped(test::arbitrary_rotation(), 1));
}

TEST(Material, ScalingTheBodyScalesTheFracture) {
  expect_same_fracture(run_mapped(Mat3::Identity(), 1), run_mapped(Mat3::Identity(), 100));
}

TEST(Material, ScalingByAPowerOfTwoKeepsTheBits) {
  const RunResult a = run_mapped(Mat3::Identity(), 1), b = run_mapped(Mat3::Identity(), 4);
  ASSERT_EQ(a.crack.node_count(), b.crack.node_count());
  for (std::size_t i = 0; i < a.crack.node_count(); ++i)
    ASSERT_EQ(a.crack.positions[NodeId(i)], b.crack.positions[NodeId(i)]);
}

/// What the boundary elements have seen and computed, front point by front point.
std::string front_text(const RunResult& result) {
  std::string text;
  for (const FrontRow& row : result.front)
    text += fmt::format("{} {} {} {} {} {}\n", row.frame, row.front, row.node, test::text(row.position),
                        test::text(Vec3(row.intensity[0], row.intensity[1], row.intensity[2])),
                        test::text(Vec3(row.opening[0], row.opening[1], row.opening[2])));
  return text;
}

// Twice as fine: the same surface well within the old spacing, from the same boundary elements, bit for bit.
// What it costs: bench/run_bench.cpp, surface_refined.
TEST(Material, RefiningTheSurfaceRefinesTheSurfaceOnly) {
  const std::string grains = "[material.toughness_field]\nkind = 'grains'\nsize = 0.2\nweakening = 0.5\n";
  for (const std::string& field : {std::string(), grains, noise_text(0.2, 0.2, 3), noise_text(0.2, 0.3),
                                   layers_text({0.3, 0, 1}, 0.2, 0.3)}) {
    const RunResult coarse = test::run_text(cube_text(field, 0.02)),
                    fine = test::run_text(cube_text(field, 0.01));
    EXPECT_EQ(coarse.document.stop, StopReason::separated);
    EXPECT_EQ(front_text(coarse), front_text(fine));
    EXPECT_EQ(coarse.fragments.size(), fine.fragments.size());
    EXPECT_LT(symmetric_distance(coarse.crack, fine.crack, 5000).mean, 0.3 * 0.02);
    RecordProperty("apart", test::text(symmetric_distance(coarse.crack, fine.crack, 5000).mean));
  }
}

}  // namespace
}  // namespace conchoid
