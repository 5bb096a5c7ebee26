#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// A crack halfway through a wall, with elements as long as the wall is thick and longer: how the wall bends in answer to it
// decides K, which the pieces near the crack let it. Tada's handbook, plane strain: here ν = 0, so that the whole width is alike.
namespace conchoid {
namespace {

constexpr double kLength = 1, kWidth = 0.3, kThickness = 0.1, kDepth = 0.05, kStress = 1e6;
constexpr double kPlace = 0.013;  // of the crack along the wall: between nodes

enum class Load { tension, bending };

/// K over σ √(π a) at depth/thickness x.
double handbook(Load load, double x) {
  const double angle = std::numbers::pi / 2 * x, missing = 1 - std::sin(angle);
  const double strip = std::sqrt(std::tan(angle) / angle);
  return load == Load::tension
             ? strip * (0.752 + 2.02 * x + 0.37 * missing * missing * missing) / std::cos(angle)
             : strip * (0.923 + 0.199 * std::pow(missing, 4)) / std::cos(angle);
}

std::string wall_text(const test::TemporaryFolder& folder, Load load, double edge,
                      const std::string& elements) {
  const int n = static_cast<int>(std::lround(kLength / edge)),
            m = std::max(1, static_cast<int>(std::lround(kWidth / edge)));
  const TriMesh mesh = box_mesh({kLength, kWidth, kThickness}, n + n % 2, m,
                                std::max(1, static_cast<int>(std::lround(kThickness / edge))));
  std::string text = test::mesh_body_text(test::write_mesh_in(folder, "wall.obj", mesh)) +
                     test::material_text({.E = 7e10, .nu = 0}) + test::resolution_text(kDepth / 3, 0.005);
  text += test::region_text("left", test::half_space_text({-1, 0, 0}, kLength / 2 - 1e-6)) +
          test::region_text("right", test::half_space_text({1, 0, 0}, kLength / 2 - 1e-6));
  if (load == Load::tension)
    text += test::boundary_text("left", "traction", {-kStress, 0, 0}) +
            test::boundary_text("right", "traction", {kStress, 0, 0});
  else
    text +=
        "[[boundary]]\nregion = 'left'\nfixed = true\n" +
        test::boundary_text("right", "force",
                            {0, 0, -kStress * kWidth * kThickness * kThickness / 6 / (kLength / 2 - kPlace)});
  return text +
         fmt::format(
             "[[crack]]\nkind = 'rectangle'\ncenter = [{}, 0, {}]\nedges = [[0, {}, 0], [0, 0, {}]]\n",
             kPlace, kThickness / 2 - kDepth + 0.035, kWidth + 0.1, 0.07) +
         fmt::format("[run]\nelements = '{}'\n", elements);
}

double shown(Load load, double edge, const std::string& elements) {
  const test::TemporaryFolder folder;
  const SifReport report = compute_sifs(test::scene_from_text(wall_text(folder, load, edge, elements)));
  double sum = 0, count = 0;
  for (const auto& front : report.fronts)
    for (const SifNode& n : front.nodes)
      if (std::abs(n.position.y()) < kWidth / 3) {
        sum += n.intensity[0];
        ++count;
      }
  return sum / count / (kStress * std::sqrt(std::numbers::pi * kDepth) * handbook(load, kDepth / kThickness));
}

}  // namespace

TEST(HandbookOfStrips, HalfwayThrough) {
  EXPECT_NEAR(handbook(Load::tension, 0.5), 2.826, 0.01);
  EXPECT_NEAR(handbook(Load::bending, 0.5), 1.475, 0.01);
}

struct Case {
  Load load;
  double edge;
};

class ThinWallCrack : public testing::TestWithParam<Case> {};

TEST_P(ThinWallCrack, OpensAsTheHandbookSays) {
  const auto& [load, edge] = GetParam();
  for (const char* elements : {"linear", "quadratic"}) {
    const double found = shown(load, edge, elements);
    RecordProperty(elements, test::text(found));
    EXPECT_NEAR(found, 1, 0.08) << elements;
  }
}

INSTANTIATE_TEST_SUITE_P(Strip, ThinWallCrack,
                         testing::Values(Case{Load::tension, 0.1}, Case{Load::tension, 0.2},
                                         Case{Load::tension, 0.3}, Case{Load::bending, 0.1},
                                         Case{Load::bending, 0.2}, Case{Load::bending, 0.3}));

}  // namespace conchoid
