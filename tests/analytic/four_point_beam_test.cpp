#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// A beam whose end faces keep their height and nothing else, so that they turn freely, and two forces on its top.
namespace conchoid {
namespace {

constexpr double kLength = 0.16, kWidth = 0.015, kHeight = 0.02, kInner = 0.025, kForce = 100;  // of each

std::string beam_text(const test::TemporaryFolder& folder, double strength) {
  const std::string roller = "displacement = ['free', 'free', 0.0]\n";
  const auto end = [&](double side) {
    const std::string name = side > 0 ? "right" : "left";
    return test::region_text(name, test::half_space_text({side, 0, 0}, kLength / 2 - 1e-6)) +
           fmt::format("[[boundary]]\nregion = '{}'\n", name) + roller;
  };
  const auto strip = [&](double side) {  // one element to either side of the force
    const std::string name = side > 0 ? "load-right" : "load-left";
    return test::region_text(
               name, fmt::format("[0, 0, 1, {}], [{}, 0, 0, {}], [{}, 0, 0, {}]", kHeight / 2 - 1e-6, side,
                                 kInner - 0.0051, -side, -(kInner + 0.0051))) +
           test::boundary_text(name, "force", {0, 0, -kForce});
  };
  return test::mesh_body_text(
             test::write_mesh_in(folder, "beam.obj", box_mesh({kLength, kWidth, kHeight}, 32, 3, 4))) +
         test::material_text({.strength = strength}) + test::resolution_text(0.004, 0.0004) + end(-1) +
         end(1) + strip(-1) + strip(1);
}

double stress_of_theory() {
  return kForce * (kLength / 2 - kInner) / (kWidth * kHeight * kHeight / 6);
}

}  // namespace

TEST(FourPointBeam, IsStressedAsInBeamTheoryBetweenTheForces) {
  const test::TemporaryFolder folder;
  const StressReport report = compute_stress(test::scene_from_text(beam_text(folder, 1e9)));
  double sum = 0, area = 0, worst = 0;
  for (std::size_t t = 0; t < report.triangles.size(); ++t) {
    const auto& triangle = report.triangles[t];
    if (triangle.centroid.z() > -kHeight / 2 + 1e-9 || std::abs(triangle.centroid.x()) > kInner - 0.01)
      continue;
    sum += triangle.principal[0];
    area += 1;
    worst = std::max(worst, std::abs(triangle.principal[0] / stress_of_theory() - 1));
  }
  ASSERT_GT(area, 0);
  EXPECT_NEAR(sum / area / stress_of_theory(), 1, 0.02);
  RecordProperty("mean", test::text(sum / area / stress_of_theory()));
  RecordProperty("worst", test::text(worst));
}

TEST(FourPointBeam, CracksFromTheSpanOfConstantMoment) {
  const test::TemporaryFolder folder;
  const Scene scene = test::scene_from_text(beam_text(folder, 0.9 * stress_of_theory()));
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  const StepReport report = fracture.step();
  ASSERT_EQ(report.new_cracks, 1u);
  EXPECT_LT(std::abs(report.start.position.x()), kInner);
  EXPECT_NEAR(report.start.position.z(), -kHeight / 2, kHeight / 8) << "at the bottom, up to half an element";
  EXPECT_NEAR(std::abs(unit_normal(fracture.crack().trimmed, TriId(0)).x()), 1, 0.02) << "across the beam";
}

}  // namespace conchoid
