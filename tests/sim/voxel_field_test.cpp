#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "conchoid/material/layers.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/study/surface_distance.hpp"
#include "scenes.hpp"
#include "vdb_file.hpp"

// Whole runs with a toughness field out of a .vdb file.
namespace conchoid {
namespace {

constexpr double kSurface = 0.02;  // spacing of the crack surface
constexpr double kVoxel = 0.02;    // a tenth of the layers' wavelength
constexpr double kWavelength = 0.2, kAmplitude = 0.4, kTilt = 0.26;

Vec3 across_layers() {
  return {std::sin(kTilt), 0, std::cos(kTilt)};
}

RunResult run(const std::string& field) {
  RunOptions options;
  options.progress = false;
  return run_scene(test::scene_from_text(test::cracked_cube_text(field, 0.1, kSurface)), options);
}

std::string layers_text() {
  return fmt::format(
      "[[material.toughness_field]]\nkind = 'layers'\ndirection = {}\nwavelength = {}\namplitude = {}\n",
      test::text(across_layers()), kWavelength, kAmplitude);
}

class VoxelField : public testing::Test {
 protected:
  /// A scene's table for the file with these grids. @param keys  lines with the other keys
  std::string table(const openvdb::GridPtrVec& grids, const std::string& keys) const {
    const std::string file = (folder_.path() / "field.vdb").string();
    test::write_vdb(file, grids);
    return fmt::format("[[material.toughness_field]]\nkind = 'vdb'\nfile = '{}'\n{}", file, keys);
  }

 private:
  test::TemporaryFolder folder_;
};

double apart(const RunResult& a, const RunResult& b) {
  return symmetric_distance(a.crack, b.crack, 5000).mean;
}

void expect_same_outcome(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.document.stop, StopReason::separated);
  EXPECT_EQ(a.document.stop, b.document.stop);
  EXPECT_EQ(a.document.frames, b.document.frames);
  EXPECT_EQ(a.fragments.size(), b.fragments.size());
}

// Voxels of the whole cube in centimetres, in a file with a second grid: the scene names grid and scale.
TEST_F(VoxelField, SampledLayersBreakLikeLayers) {
  constexpr double kCentimetre = 0.01;
  const Layers layers{across_layers(), kWavelength, kAmplitude, 0};
  const auto grid = test::sampled_grid("toughness", kVoxel / kCentimetre, {-27, -27, -27}, {27, 27, 27},
                                       [&](const Vec3& x) { return layers.at(kCentimetre * x).value; });
  const auto other = test::sampled_grid("density", kVoxel / kCentimetre, {-27, -27, -27}, {27, 27, 27},
                                        [](const Vec3& x) { return 2 + std::sin(x[0]); });
  const RunResult sampled =
                      run(table({other, grid}, fmt::format("grid = 'toughness'\nscale = {}\n", kCentimetre))),
                  exact = run(layers_text()), plain = run("");
  expect_same_outcome(sampled, exact);
  EXPECT_LT(apart(sampled, exact), 0.1 * kSurface);
  EXPECT_GT(apart(plain, exact), 0.5 * kSurface);  // the layers were felt
  RecordProperty("apart", test::text(apart(sampled, exact)));
  RecordProperty("plain", test::text(apart(plain, exact)));
}

// One wavelength of voxels, one across, over and over along axes that are turned with the layers; and the
// same voxels for the whole cube.
TEST_F(VoxelField, APeriodicBoxIsAsGoodAsAGridOfTheWholeBody) {
  const Layers layers{Vec3::UnitZ(), kWavelength, kAmplitude, 0};
  const auto factor = [&](const Vec3& x) { return layers.at(x).value; };
  const std::string axes =
      fmt::format("axes = [{}, {}, {}]\n", test::text(Vec3(std::cos(kTilt), 0, -std::sin(kTilt))),
                  test::text(Vec3::UnitY()), test::text(across_layers()));
  const RunResult periodic = run(table({test::sampled_grid("K", kVoxel, {0, 0, 0}, {0, 0, 9}, factor)},
                                       axes + "outside = 'periodic'\n")),
                  whole =
                      run(table({test::sampled_grid("K", kVoxel, {0, 0, -50}, {0, 0, 50}, factor)}, axes)),
                  exact = run(layers_text());
  expect_same_outcome(periodic, whole);
  expect_same_outcome(periodic, exact);
  EXPECT_LT(apart(periodic, whole), 1e-12);
  EXPECT_LT(apart(periodic, exact), 0.1 * kSurface);
  RecordProperty("whole", test::text(apart(periodic, whole)));
  RecordProperty("exact", test::text(apart(periodic, exact)));
}

// A factor of one on top of the layers. The weights of a spline add up to one but for the last bit: the same
// surface node by node, not the same bits.
TEST_F(VoxelField, AGridOfOnesChangesNothing) {
  const RunResult layers = run(layers_text());
  const auto one = test::sampled_grid("K", 1, {-1, -1, -1}, {1, 1, 1}, [](const Vec3&) { return 1; });
  for (const char* outside : {"clamped", "periodic"}) {
    const RunResult both =
        run(layers_text() + table({one}, fmt::format("scale = 0.25\noutside = '{}'\n", outside)));
    expect_same_outcome(both, layers);
    ASSERT_EQ(both.crack.node_count(), layers.crack.node_count());
    EXPECT_EQ(both.crack.corners, layers.crack.corners);
    for (std::size_t n = 0; n < layers.crack.node_count(); ++n)
      EXPECT_NEAR((both.crack.positions[NodeId(n)] - layers.crack.positions[NodeId(n)]).norm(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace conchoid
