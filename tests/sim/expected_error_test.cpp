#include "conchoid/sim/expected_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "conchoid/crack/law/criterion.hpp"

// What a predicted crack is expected to be off by.
namespace conchoid {
namespace {

const ElasticConstants kMaterial{3.1e9, 0.327};
constexpr double kDiagonal = 2, kEdge = 0.1;

// A front of three points in frame n, each grown from the one in the frame before.
CrackState front(int n) {
  CrackState crack;
  for (int i = 0; i < 3; ++i) {
    const NodeId before = n > 0 ? NodeId(10 * (n - 1) + i) : NodeId{};
    const FrontFrame frame{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
    crack.points.push_back({NodeId(10 * n + i), before, frame, kEdge, 0});
  }
  return crack;
}

// K of that kink angle, or nearly.
Vec3 turning(double angle) {
  return {1e6, -0.5e6 * angle, 0};
}

std::vector<FrontOpening> openings(const Vec3& K, const Vec3& spread = Vec3::Zero()) {
  FrontOpening o;
  o.intensity = K;
  o.spread = spread;
  return {3, o};
}

double stated(const Vec3& K, const Vec3& spread = Vec3::Zero()) {
  return stated_angle_error(openings(K, spread)[0], kEdge, kMaterial);
}

TEST(StatedAngleError, IsTheSpreadOfTheAngleOrTheAngleItself) {
  const Vec3 K = turning(0.2);
  EXPECT_DOUBLE_EQ(stated(K), std::abs(kink_angle(K, kMaterial)));
  const double slope =
      (kink_angle(K + Vec3(0, 1, 0), kMaterial) - kink_angle(K - Vec3(0, 1, 0), kMaterial)) / 2;
  EXPECT_NEAR(stated(K, {0, 3e4, 0}), 3e4 * std::abs(slope), 1e-3);
  EXPECT_GT(stated(K, {3e4, 3e4, 3e4}), stated(K, {0, 3e4, 0}));
  // A physically scaled copy states the same.
  EXPECT_NEAR(stated(7 * K, {0, 7 * 3e4, 0}), stated(K, {0, 3e4, 0}), 1e-12);
}

TEST(StatedAngleError, IsNeverNothing) {
  EXPECT_EQ(stated({1e6, 0, 0}), kLeastAngleError);
  FrontOpening outside = openings({1e6, 0, 0})[0];
  outside.in_range = false;
  EXPECT_EQ(stated_angle_error(outside, kEdge, kMaterial), kOutsideAngleError);
  // Through a ligament the front goes straight on, whatever K says.
  EXPECT_EQ(stated(1e6 * turning(0.5)), kLeastAngleError);
}

TEST(ExpectedError, GrowsWithTheSquareOfTheFramesPredicted) {
  ExpectedError error(kMaterial, kDiagonal, kEdge);
  const auto predicted = openings(turning(0.01));
  const double s = ExpectedError::kUnknown.first_scale * stated(turning(0.01));
  double distance = 0, sum = 0;
  for (int n = 0; n < 4; ++n) {
    const double before = distance;
    distance += kEdge * std::sin((n + 1) * s);
    EXPECT_NEAR(error.at_the_end(front(n), predicted, 1), distance / kDiagonal, 1e-15);
    sum += 0.5 * (before + distance) / kDiagonal;
    EXPECT_NEAR(error.at_the_end(front(n), predicted, 0), sum / (n + 1), 1e-15);
    EXPECT_NEAR(error.at_the_end(front(n), predicted, 0.3), 0.7 * sum / (n + 1) + 0.3 * distance / kDiagonal,
                1e-15);
    error.advance_predicted(front(n), predicted);
    EXPECT_NEAR(error.of_surface(), sum / (n + 1), 1e-15);
  }
}

// Independent turns: after n frames the distance has the variance r̄² Σ k² s², k = 1 … n.
TEST(ExpectedError, ScatterWalks) {
  ExpectedError error(kMaterial, kDiagonal, kEdge, ExpectedError::kCalibrated);
  const Vec3 K = turning(0.02), spread(0, 2e4, 0);
  const double s = ExpectedError::kCalibrated.along_front * stated(K, spread);
  EXPECT_EQ(error.scale(), 1);
  double squares = 0;
  for (int n = 0; n < 6; ++n) {
    squares += (n + 1) * (n + 1);
    const double distance = kEdge * s * std::sqrt(squares);
    EXPECT_NEAR(error.at_the_end(front(n), openings(K, spread), 1) * kDiagonal / distance, 1, 1e-3) << n;
    error.advance_predicted(front(n), openings(K, spread));
  }
}

// A calibrated statement counts as one comparison.
TEST(ExpectedError, OneFrameDoesNotUndoACalibration) {
  const Vec3 K = turning(0.02), spread(0, 1e4, 0);
  ExpectedError error(kMaterial, kDiagonal, kEdge, ExpectedError::kCalibrated);
  error.advance_solved(front(0), openings(K), openings(K, spread));  // as predicted
  EXPECT_NEAR(error.scale(), 1 / std::numbers::sqrt2, 1e-12);
}

TEST(ExpectedError, APointThatStaysAddsNothingByStaying) {
  ExpectedError error(kMaterial, kDiagonal, kEdge);
  const auto predicted = openings(turning(0.01));
  error.advance_predicted(front(0), predicted);
  const double once = error.at_the_end(front(0), predicted, 1);
  error.advance_predicted(front(0), predicted);
  EXPECT_EQ(error.at_the_end(front(0), predicted, 1), once);
}

TEST(ExpectedError, ASolvedFrameTurnsTheCrackBackFromWhereItIs) {
  ExpectedError error(kMaterial, kDiagonal, kEdge);
  const auto predicted = openings(turning(0.02));
  const double step = error.at_the_end(front(0), predicted, 1);
  error.advance_predicted(front(0), predicted);
  error.advance_solved(front(1), predicted, {});
  const double surface = error.of_surface();
  EXPECT_NEAR(surface, (0.5 * step + step) / 2, 1e-15);
  // The next stretch begins anew, and adds in quadrature.
  EXPECT_NEAR(error.at_the_end(front(2), predicted, 1), std::sqrt(2.0) * step, 1e-15);
}

TEST(ExpectedError, TakesItsScaleFromFramesThatWereSolvedToo) {
  const Vec3 K = turning(0.02), spread(0, 1e4, 0);
  const double s = stated(K, spread);
  for (const double true_error : {0.5 * s, 3 * s}) {
    ExpectedError error(kMaterial, kDiagonal, kEdge);
    Vec3 solved = K;  // whose angle is off by that much: by bisection
    double low = 0, high = 1e6;
    for (int i = 0; i < 60; ++i) {
      solved[1] = K[1] - 0.5 * (low + high);
      (kink_angle(solved, kMaterial) - kink_angle(K, kMaterial) < true_error ? low : high) = K[1] - solved[1];
    }
    error.advance_solved(front(0), openings(solved), openings(K, spread));
    EXPECT_NEAR(error.scale(), true_error / s, 1e-6);
    error.advance_solved(front(1), openings(K), openings(K, spread));  // as predicted
    EXPECT_NEAR(error.scale(), true_error / s / std::numbers::sqrt2, 1e-6);
  }
}

}  // namespace
}  // namespace conchoid
