#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "conchoid/formats/formats.hpp"
#include "conchoid/sim/run.hpp"
#include "scans.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

// examples/armadillo.toml with the scan where it lies, coarser where only the picture needs it fine.
std::string example_text(const test::Scan& scan) {
  std::ifstream in(std::filesystem::path(CONCHOID_SOURCE_DIR) / "examples/armadillo.toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string s = text.str();
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = s.find(from);
    if (at == std::string::npos) throw std::runtime_error("the example has changed: " + from);
    s.replace(at, from.size(), to);
  };
  replace("mesh = \"armadillo.ply\"", "mesh = \"" + scan.file.string() + "\"");
  replace("remesh = 1000", "remesh = " + std::to_string(scan.elements));
  replace("surface = 0.4", "surface = 1.0");
  return s;
}

using Armadillo = test::ScanTest;

TEST_P(Armadillo, BreaksIntoPiecesThatKeepTheScan) {
  const test::Scan& scan = GetParam();
  RunOptions options;
  options.progress = false;
  const RunResult result = run_scene(test::scene_from_text(example_text(scan)), options);
  EXPECT_EQ(result.document.stop, StopReason::separated);
  EXPECT_GE(result.cracks, 1);
  EXPECT_GE(result.fragments.size(), 2u);
  const TriMesh original = read_mesh(scan.file);
  double volume = 0;
  std::set<std::array<double, 3>> kept;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight);
    volume += f.volume;
    for (const Vec3& x : f.mesh.positions)
      kept.insert({x[0], x[1], x[2]});
  }
  EXPECT_NEAR(volume, enclosed_volume(original), 0.005 * enclosed_volume(original));
  // Far from every crack all nodes of the scan are there, bit for bit.
  std::vector<Vec3> crack(result.crack.positions.begin(), result.crack.positions.end());
  std::size_t far = 0;
  for (const Vec3& x : original.positions) {
    const bool near =
        std::any_of(crack.begin(), crack.end(), [&](const Vec3& c) { return (c - x).norm() < 2; });
    if (near) continue;
    ++far;
    ASSERT_TRUE(kept.contains({x[0], x[1], x[2]})) << x.transpose();
  }
  EXPECT_GT(far, original.node_count() * 9 / 10);
  RecordProperty("pieces", static_cast<int>(result.fragments.size()));
}

INSTANTIATE_TEST_SUITE_P(Scans, Armadillo, testing::ValuesIn(test::scans()), test::scan_name);

}  // namespace
}  // namespace conchoid
