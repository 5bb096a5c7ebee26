#include "conchoid/sim/front_surroundings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

constexpr double kRadius = 0.2, kStress = 1e7;

struct Measured {
  CrackState crack;
  std::vector<Sample> samples;  // of the points, as if the crack had stood still for a frame
};

Measured measured(const Scene& scene) {
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  Measured out;
  struct Keep : FractureObserver {
    explicit Keep(Measured& to) : out(to) {}
    void on_opening(const Fracture& f) override {
      out.crack = f.crack();
      FrontSurroundings around(f.body());
      around.measure(f.crack(), f.load(), 0);
      around.remember(f.crack(), f.openings());
      CrackState still = f.crack();
      ++still.sheet.frame;
      for (FrontPoint& point : still.points)
        point.correlation = point.node;
      around.measure(still, f.load(), 0);
      for (std::size_t i = 0; i < still.points.size(); ++i) {
        Sample s;
        EXPECT_TRUE(around.complete(still, i, still.points[i].correlation, s));
        out.samples.push_back(s);
      }
    }
    Measured& out;
  } keep(out);
  fracture.add_observer(keep);
  fracture.step();
  return out;
}

/// The cube pulled along z with a disc across its middle: everything about it is known.
Measured disc_in_cube() {
  return measured(test::scene_from_text(test::cracked_cube_text("", 0.1, 0.02)));
}

TEST(FrontSurroundings, ADiscInAPulledCubeIsDescribedExactly) {
  const Measured m = disc_in_cube();
  ASSERT_GT(m.samples.size(), 10u);
  for (std::size_t i = 0; i < m.samples.size(); ++i) {
    const Sample& s = m.samples[i];
    const Vec3& x = m.crack.sheet.mesh.positions[m.crack.points[i].node];
    const Vec3 out = Vec3(x[0], x[1], 0).normalized();
    const double reach = out.cwiseAbs().maxCoeff();
    EXPECT_NEAR(s.surface_distance_after, 0.5 / reach - kRadius, 0.01);
    EXPECT_NEAR(s.wall_distance_after, 0.5 - kRadius * reach, 1e-9);
    EXPECT_NEAR(s.front_curvature_after, 1 / kRadius, 0.1);
    EXPECT_NEAR(s.traction_after[0], kStress, 0.02 * kStress);
    EXPECT_NEAR(s.traction_after[1], 0, 0.02 * kStress);
    EXPECT_NEAR(s.lateral_after.norm(), 0, 0.03 * kStress);
    EXPECT_NEAR(s.crack_radius, kRadius, 0.01);
    EXPECT_NEAR(s.turn.norm(), 0, 1e-12) << "it stands still";
    EXPECT_NEAR(s.driving[0], 2 * kStress * std::sqrt(kRadius / std::numbers::pi), 0.2 * s.driving[0]);
    EXPECT_NEAR((s.driving - s.driving_front).norm(), 0, 0.1 * s.driving[0]);
    EXPECT_EQ(s.traction, s.traction_after);
  }
  // Edges of the front times what lies ahead of them: between the rings of radius 0.5 and 0.5 √2, cut off straight ahead.
  const double share = m.samples[0].ligament_share;
  EXPECT_GT(share, 0.6);
  EXPECT_LT(share, 0.9);
}

// A bar of width 1 with a crack of depth a in its side, pulled: σ/(1 − a) (1 + 3 a/(1 − a)) at the front (Navier).
TEST(FrontSurroundings, TheLigamentOfAnEdgeCrackTakesOverTheTextbooksStress) {
  constexpr double a = 0.3;
  const Measured m = measured(test::scene_from_text(
      "[body]\nmodel = 'edge-crack-cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, kStress}) +
      test::boundary_text("z-", "traction", {0, 0, -kStress}) + "[run]\nmax_cracks = 0\n"));
  ASSERT_GT(m.samples.size(), 5u);
  const double net = kStress / (1 - a) * (1 + 3 * a / (1 - a));
  for (std::size_t i = 0; i < m.samples.size(); ++i) {
    const Sample& s = m.samples[i];
    EXPECT_NEAR(s.traction_after[0] + s.taken_over_after[0], net, 0.02 * net);
    EXPECT_NEAR(s.taken_over_after.tail<2>().norm(), 0, 0.02 * net);
    EXPECT_NEAR((s.crack_force - a * kStress * Vec3::UnitX()).norm(), 0, 0.02 * a * kStress);
    EXPECT_NEAR(std::abs(s.crack_moment[2]), a * a / 2 * kStress, 0.03 * a * a / 2 * kStress);
    const double arms = std::sqrt(12.0) * a * a / 2 * kStress / std::pow(0.5, 1.5);
    EXPECT_NEAR(s.arms_after, arms, 0.03 * arms);
    const double side = m.crack.sheet.mesh.positions[m.crack.points[i].node].dot(m.crack.points[i].frame.e3);
    EXPECT_NEAR(s.beside[0], 0.5, 1e-9) << "above";
    EXPECT_NEAR(s.beside[1], 0.5, 1e-9) << "below";
    EXPECT_NEAR(s.beside[2], 0.5 * std::numbers::sqrt2, 1e-9) << "above and ahead";
    EXPECT_NEAR(s.beside[4], a * std::numbers::sqrt2, 1e-9) << "above and behind";
    EXPECT_NEAR(s.beside[6], 0.5 - side, 1e-9);
    EXPECT_NEAR(s.beside[7], 0.5 + side, 1e-9);
  }
}

TEST(FrontSurroundings, AnInfiniteBodyTakesNothingOver) {
  const Measured m = measured(test::scene_from_text(
      "[body]\nmodel = 'infinite'\n" + test::material_text() +
      "[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.5\ntriangles = 100\n" +
      test::remote_stress_text(kStress * Vec3(0, 0, 1).asDiagonal())));
  ASSERT_GT(m.samples.size(), 5u);
  for (const Sample& s : m.samples) {
    EXPECT_EQ(s.taken_over_after, Vec3::Zero());
    EXPECT_EQ(s.arms_after, 0);
    EXPECT_GT(s.crack_force[0], 0.7 * kStress * std::numbers::pi / 4) << "of a polygon in the circle";
  }
}

SampleSet recorded(const std::string& text, SampleRecorder::Fields fields) {
  const Scene scene = test::scene_from_text(text);
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  SampleRecorder recorder(fields);
  fracture.add_observer(recorder);
  for (int frame = 0; frame < 6 && fracture.step().moving; ++frame) {
  }
  return recorder.take();
}

TEST(FrontSurroundings, NodesThatAreNewAtTheEndOfAFrontAreLearnedFromWithThePastOfTheirNeighbour) {
  const std::string torn =
      "[body]\nmodel = 'edge-crack-cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", 1e7 * Vec3::UnitY()) +
      test::boundary_text("z-", "traction", -1e7 * Vec3::UnitY()) + "[run]\ninertia_relief = true\n";
  const SampleSet samples = recorded(torn, SampleRecorder::Fields::all);
  std::size_t fresh = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    if (!is_new_on_front(s)) continue;
    ++fresh;
    EXPECT_GT(s.driving_after.norm(), 0) << "its own";
    const bool shared = (i > 0 && samples[i - 1].driving == s.driving) ||
                        (i + 1 < samples.size() && samples[i + 1].driving == s.driving);
    EXPECT_TRUE(shared) << "frame " << s.frame << ", node " << s.node;
  }
  EXPECT_GT(fresh, 0u);
  const SampleSet published = recorded(torn, SampleRecorder::Fields::free);
  EXPECT_EQ(published.size(), samples.size() - fresh) << "the published method has no past for them";
}

TEST(FrontSurroundings, RecordedSamplesPairSuccessiveFramesOncePerCorrelationNode) {
  const SampleSet samples = recorded(test::pulled_cube_text(), SampleRecorder::Fields::all);
  ASSERT_GT(samples.size(), 20u);
  EXPECT_NO_THROW(samples.validate());
  EXPECT_NO_THROW(require_recorded(FeatureSet::versatile, samples));
  EXPECT_NO_THROW(require_recorded(FeatureSet::dimensionless_context, samples));
  std::set<std::pair<int, int>> seen;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    EXPECT_TRUE(seen.insert({s.frame, s.node}).second) << "frame " << s.frame << ", node " << s.node;
    EXPECT_GT(s.driving.norm(), 0);
    EXPECT_GE(s.ligament_share, 0);
    EXPECT_LE(s.ligament_share, 1);
  }
}

}  // namespace
}  // namespace conchoid
