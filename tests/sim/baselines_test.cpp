#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/sim/run.hpp"
#include "conchoid/sim/stress_opening.hpp"
#include "scenes.hpp"

// Closed forms that predict the opening without training: steady, kept, stress; and solving every Nth frame.
namespace conchoid {
namespace {

constexpr double kNu = 0.327;

FrontFrame some_frame() {
  const Mat3 R = test::arbitrary_rotation();
  return {R.col(0), R.col(1), R.col(2)};
}

/// Uniaxial tension s along `direction`.
Mat3 tension(double s, const Vec3& direction) {
  return s * direction * direction.transpose();
}

TEST(IntensityFromStress, PennyCrackUnderTensionIsExact) {
  const FrontFrame f = some_frame();
  const double s = 2e6, a = 0.3;
  const Vec3 K = intensity_from_stress(tension(s, f.e1), f, std::numbers::pi * a * a, kEmbeddedFactor, kNu);
  EXPECT_NEAR(K[0], 2 * s * std::sqrt(a / std::numbers::pi), 1e-12 * K[0]);
  EXPECT_NEAR(K[1], 0, 1e-9 * K[0]);
  EXPECT_NEAR(K[2], 0, 1e-9 * K[0]);
  EXPECT_NEAR(intensity_from_stress(tension(-s, f.e1), f, 1, 1, kNu)[0],
              -intensity_from_stress(tension(s, f.e1), f, 1, 1, kNu)[0], 1e-9 * K[0]);
}

// The law of growth turns the front until its normal lies along the pull, over the whole range of kinks.
TEST(IntensityFromStress, TurnsTheFrontAcrossThePull) {
  const FrontFrame f = some_frame();
  const HoopStressLaw law({3.1e9, kNu}, std::nullopt);
  for (double degrees = -68; degrees <= 68; degrees += 8.5) {
    const double theta = degrees * std::numbers::pi / 180;
    const Vec3 normal = std::cos(theta) * f.e1 - std::sin(theta) * f.e2;
    const Vec3 K = intensity_from_stress(tension(1e6, normal), f, 0.5, 1, kNu);
    EXPECT_NEAR(law.direction(K), theta, 1e-9) << degrees;
  }
}

TEST(IntensityFromStress, ReversedNormalNegatesModeTwoAlone) {
  const FrontFrame f = some_frame();
  const FrontFrame reversed{-f.e1, f.e2, -f.e3};
  const Mat3 stress = tension(1e6, (f.e1 + 0.3 * f.e2 - 0.2 * f.e3).normalized()) + tension(2e5, f.e2);
  const Vec3 K = intensity_from_stress(stress, f, 0.5, 1, kNu);
  const Vec3 R = intensity_from_stress(stress, reversed, 0.5, 1, kNu);
  EXPECT_GT(std::abs(K[1]), 0.05 * K[0]);
  EXPECT_GT(std::abs(K[2]), 0.05 * K[0]);
  EXPECT_LT((R - Vec3(K[0], -K[1], K[2])).norm(), 1e-9 * K.norm());
}

TEST(IntensityFromStress, SignOfModeThreeIsThatOfTheShear) {
  const FrontFrame f = some_frame();
  const Mat3 stress = tension(1e6, (f.e1 + 0.2 * f.e3).normalized());
  EXPECT_GT(intensity_from_stress(stress, f, 0.5, 1, kNu)[2] * f.e3.dot(stress * f.e1), 0);
}

TEST(IntensityFromStress, ScalesWithStressAndFourthRootOfArea) {
  const FrontFrame f = some_frame();
  const Mat3 stress = tension(1e6, (f.e1 + 0.3 * f.e2).normalized());
  const Vec3 K = intensity_from_stress(stress, f, 0.5, 1, kNu);
  EXPECT_LT((intensity_from_stress(3 * stress, f, 0.5, 1, kNu) - 3 * K).norm(), 1e-9 * K.norm());
  EXPECT_LT((intensity_from_stress(stress, f, 8, 1, kNu) - 2 * K).norm(), 1e-9 * K.norm());
  EXPECT_EQ(intensity_from_stress(Mat3::Zero(), f, 0.5, 1, kNu), Vec3(Vec3::Zero()));
}

RunResult run(const std::string& text, const std::string& method, std::optional<int> frames = {}) {
  RunOptions options;
  options.method = method;
  options.progress = false;
  options.frames = frames;
  return run_scene(test::scene_from_text(text), options);
}

std::string penny_text() {
  return "[body]\nmodel = 'infinite'\n" + test::material_text() + test::resolution_text(0.05, 0.05) +
         "[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.2\n" +
         test::remote_stress_text(Vec3(0, 0, 5e6).asDiagonal()) + "[run]\nmax_cracks = 0\n";
}

// (mean K_I, largest |K_II|, |K_III| of a frame, mean radius)
std::array<double, 3> penny_frame(const RunResult& result, int frame) {
  double K = 0, side = 0, radius = 0, n = 0;
  for (const FrontRow& row : result.front)
    if (row.frame == frame) {
      K += row.intensity[0];
      side = std::max({side, std::abs(row.intensity[1]), std::abs(row.intensity[2])});
      radius += row.position.norm();
      n += 1;
    }
  return {K / n, side, radius / n};
}

TEST(Baselines, KeptKeepsKOfAPennyAndStressFollowsItsRadius) {
  const RunResult kept = run(penny_text(), "kept", 3), stress = run(penny_text(), "stress", 3);
  const double first = penny_frame(kept, 1)[0];
  for (const int frame : {2, 3}) {
    EXPECT_NEAR(penny_frame(kept, frame)[0], first, 0.01 * first);
    const auto [K, side, a] = penny_frame(stress, frame);
    EXPECT_NEAR(K, 2 * 5e6 * std::sqrt(a / std::numbers::pi), 0.01 * K) << "radius " << a;
    EXPECT_LT(side, 1e-2 * K);
  }
  EXPECT_GT(penny_frame(stress, 3)[2], 0.25);
}

TEST(Baselines, SolvedInEveryFrameTheyAreTheSolution) {
  const std::string text = test::pulled_cube_text();
  const std::string solved = run(text, "bem").document.hash;
  for (const char* method : {"steady", "kept", "stress"})
    EXPECT_EQ(run(text + "solve_every = 1\n", method).document.hash, solved) << method;
}

TEST(Baselines, NewCracksStartInFramesThatAreSolved) {
  const std::string text = test::pulled_cube_text() + "max_cracks = 3\n";
  const RunResult solved = run(text, "bem", 4), kept = run(text + "solve_every = 1\n", "kept", 4);
  EXPECT_GT(solved.cracks, 1);
  EXPECT_EQ(kept.cracks, solved.cracks);
  EXPECT_EQ(kept.document.hash, solved.document.hash);
}

TEST(Baselines, SolvedInEverySecondFrame) {
  const RunResult result = run(test::pulled_cube_text() + "solve_every = 2\n", "kept");
  ASSERT_GE(result.document.timings.size(), 4u);
  for (const FrameRecord& frame : result.document.timings)
    EXPECT_EQ(frame.source, frame.frame % 2 == 1 ? "bem" : "kept") << frame.frame;
  EXPECT_EQ(result.document.stop, StopReason::separated);
}

}  // namespace
}  // namespace conchoid
