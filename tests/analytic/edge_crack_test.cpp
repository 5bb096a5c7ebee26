#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

struct Strip {
  int cells = 0;  ///< across the width; four times as many along the height
  double depth = 0, height = 0;
};

void PrintTo(const Strip& s, std::ostream* out) {
  *out << "cells " << s.cells << ", depth " << s.depth << ", z = " << s.height;
}

class EdgeCrack : public testing::TestWithParam<Strip> {};

// Tada: strip of width 1 in plane strain, crack depth a
double exact_intensity(double a, double stress) {
  const double F = 0.265 * std::pow(1 - a, 4) + (0.857 + 0.265 * a) / std::pow(1 - a, 1.5);
  return stress * std::sqrt(std::numbers::pi * a) * F;
}

std::string strip_text(const Strip& s, const std::string& file, double stress) {
  return test::mesh_body_text(file) + test::material_text() + test::resolution_text(0.08, 0.02) +
         test::region_text("top", "[0, 0, 1, 1.99]") + test::region_text("bottom", "[0, 0, -1, 1.99]") +
         test::boundary_text("top", "traction", {0, 0, stress}) +
         test::boundary_text("bottom", "traction", {0, 0, -stress}) +
         fmt::format("[[crack]]\nkind = 'rectangle'\ncenter = [{}, 0, {}]\nedges = [[{}, 0, 0], [0, 1, 0]]\n",
                     -0.5 + 0.5 * s.depth, s.height, s.depth);
}

// Ends pulled; the crack runs through the whole thickness and opens at the surface. At mid-thickness the
// front is in plane strain. The mouth fits no edge of the surface mesh at z = 0.07.
TEST_P(EdgeCrack, MidFrontWithinFivePercentOfTada) {
  const Strip s = GetParam();
  const double stress = 1e6;
  const test::TemporaryFolder folder;
  const std::string file =
      test::write_mesh_in(folder, "strip.obj", box_mesh({1, 1, 4}, s.cells, s.cells, 4 * s.cells));
  const SifReport report = compute_sifs(test::scene_from_text(strip_text(s, file, stress)));
  int count = 0;
  double sum = 0;
  for (const auto& front : report.fronts)
    for (const SifNode& node : front.nodes) {
      if (std::abs(node.position.x() - (-0.5 + s.depth)) > 1e-6 || std::abs(node.position.y()) > 0.15)
        continue;
      const double ratio = node.intensity[0] / exact_intensity(s.depth, stress);
      EXPECT_NEAR(ratio, 1, 0.05) << "at y = " << node.position.y();
      EXPECT_LT(std::abs(node.intensity[1]), 0.03 * node.intensity[0]);
      sum += ratio;
      ++count;
    }
  EXPECT_GE(count, 2);
  RecordProperty("ratio", test::text(sum / count));
}

INSTANTIATE_TEST_SUITE_P(Strips, EdgeCrack,
                         testing::Values(Strip{3, 0.3, 0.0}, Strip{3, 0.3, 0.07}, Strip{3, 0.5, 0.0},
                                         Strip{3, 0.5, 0.07}, Strip{5, 0.3, 0.0}, Strip{5, 0.3, 0.07},
                                         Strip{5, 0.5, 0.0}, Strip{5, 0.5, 0.07}));

// Without lateral contraction the front is in plane strain up to the sides of the body, whose elements are up to 2.5
// crack edges long: near the mouth they are divided.
TEST(EdgeCrackWithoutContraction, EveryNodeOfTheFrontWithinFivePercentOfTada) {
  const double stress = 1e6, depth = 0.5;
  const test::TemporaryFolder folder;
  for (const int cells : {4, 7}) {
    const std::string file =
        test::write_mesh_in(folder, "strip.obj", box_mesh({1, 0.5, 4}, cells, cells / 2, 4 * cells));
    const std::string text =
        test::mesh_body_text(file) + test::material_text({.nu = 0}) + test::resolution_text(0.1, 0.02) +
        test::region_text("top", "[0, 0, 1, 1.99]") + test::region_text("bottom", "[0, 0, -1, 1.99]") +
        test::boundary_text("top", "traction", {0, 0, stress}) +
        test::boundary_text("bottom", "traction", {0, 0, -stress}) +
        "[[crack]]\nkind = 'rectangle'\ncenter = [-0.3, 0, 0.03]\nedges = [[0.6, 0, 0], [0, 0.7, 0]]\n";
    const SifReport report = compute_sifs(test::scene_from_text(text));
    ASSERT_EQ(report.fronts.size(), 1u);
    for (const SifNode& node : report.fronts[0].nodes) {
      const Vec3 K = node.intensity / exact_intensity(depth, stress);
      EXPECT_NEAR(K[0], 1, 0.05) << cells << " cells, y = " << node.position.y();
      EXPECT_LT(K.tail<2>().cwiseAbs().maxCoeff(), 0.015) << cells << " cells, y = " << node.position.y();
    }
  }
}

}  // namespace
}  // namespace conchoid
