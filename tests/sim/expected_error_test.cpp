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
  crack.fronts.emplace_back();
  crack.node_in_cut.resize(static_cast<std::size_t>(10 * n + 3));
  for (int i = 0; i < 3; ++i) {
    const NodeId node(10 * n + i);
    crack.node_in_cut[node] = node;
    crack.fronts[0].nodes.push_back(node);
    const NodeId before = n > 0 ? NodeId(10 * (n - 1) + i) : NodeId{};
    const FrontFrame frame{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
    crack.points.push_back({node, before, frame, kEdge, 0});
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

std::vector<int> once() {
  return {1, 1, 1};
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
    sum += 0.5 * (before + distance) / kDiagonal;
    EXPECT_NEAR(error.at_the_end(front(n), predicted, once()), sum / (n + 1), 1e-15);
    error.advance_predicted(front(n), predicted);
    EXPECT_NEAR(error.of_surface(), sum / (n + 1), 1e-15);
  }
}

// Independent turns: after n frames the distance has the variance r̄² Σ k² s², k = 1 … n.
TEST(ExpectedError, ScatterWalks) {
  ExpectedError error(kMaterial, kDiagonal, kEdge, ExpectedError::kCalibrated);
  const Vec3 K = turning(0.02), spread(0, 2e4, 0);
  constexpr auto statement = ExpectedError::kCalibrated;
  const double s = statement.amount * deviation_of_mean(3, statement.correlation) * stated(K, spread);
  EXPECT_EQ(error.scale(), 1);
  double squares = 0, distance = 0, sum = 0;
  for (int n = 0; n < 6; ++n) {
    squares += (n + 1) * (n + 1);
    const double before = distance;
    distance = kEdge * s * std::sqrt(squares);
    sum += 0.5 * (before + distance) / kDiagonal;
    EXPECT_NEAR(error.at_the_end(front(n), openings(K, spread), once()) / sum * (n + 1), 1, 1e-3) << n;
    error.advance_predicted(front(n), openings(K, spread));
  }
}

// What is expected of the end is what comes of it if every frame states as much; a point that is through adds no more.
TEST(ExpectedError, LooksAheadToTheEnd) {
  const auto predicted = openings(turning(0.02), {0, 2e4, 0});
  for (const auto& statement : {ExpectedError::kUnknown, ExpectedError::kCalibrated}) {
    ExpectedError error(kMaterial, kDiagonal, kEdge, statement);
    error.advance_predicted(front(0), predicted);
    error.advance_solved(front(1), predicted, {});
    const double ahead = error.at_the_end(front(2), predicted, {4, 4, 4});
    EXPECT_GT(ahead, error.at_the_end(front(2), predicted, {4, 2, 4}));
    EXPECT_GT(error.at_the_end(front(2), predicted, {4, 2, 4}),
              error.at_the_end(front(2), predicted, once()));
    for (int n = 2; n < 6; ++n)
      error.advance_predicted(front(n), predicted);
    EXPECT_NEAR(error.of_surface(), ahead, 1e-15);
  }
}

TEST(ExpectedError, AFrontAveragesTheErrorsOfItsPoints) {
  EXPECT_EQ(deviation_of_mean(1, 0.25), 1);
  for (const std::size_t n : {2, 5, 40}) {
    EXPECT_NEAR(deviation_of_mean(n, 1), 1, 1e-12);
    EXPECT_NEAR(deviation_of_mean(n, 0), 1 / std::sqrt(n), 1e-12);
    double variance = 0;  // over all pairs
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        variance += std::pow(0.25, i > j ? i - j : j - i) / static_cast<double>(n * n);
    EXPECT_NEAR(deviation_of_mean(n, 0.25), std::sqrt(variance), 1e-12);
  }
}

// A calibrated statement counts as one comparison.
TEST(ExpectedError, OneFrameDoesNotUndoACalibration) {
  const Vec3 K = turning(0.02), spread(0, 1e4, 0);
  ExpectedError error(kMaterial, kDiagonal, kEdge, ExpectedError::kCalibrated);
  error.advance_solved(front(0), openings(K), openings(K, spread));  // as predicted
  EXPECT_NEAR(error.scale(), 1 / std::numbers::sqrt2, 1e-12);
}

// Fronts in thin walls are two or three points long, and most of them have no point behind them that was on the front.
TEST(ExpectedError, APointThatComesFromNowhereIsAsFarOffAsItsFront) {
  const auto predicted = openings(turning(0.01));
  const auto after = [&](const std::vector<int>& lost) {
    ExpectedError error(kMaterial, kDiagonal, kEdge);
    error.advance_predicted(front(0), predicted);
    error.advance_predicted(front(1), predicted);
    CrackState crack = front(2);
    crack.sheet.mesh.positions.resize(30);
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 2; ++i)
        crack.sheet.mesh.corners.push_back(
            {NodeId(10 * n + i), NodeId(10 * n + i + 1), NodeId(10 * (n < 2 ? n + 1 : 0))});
    for (const int i : lost)
      crack.points[static_cast<std::size_t>(i)].correlation = {};
    error.advance_predicted(crack, predicted);
    return error.of_surface();
  };
  EXPECT_NEAR(after({1}), after({}), 1e-15);
  EXPECT_NEAR(after({0, 1, 2}), after({}), 1e-15);
}

TEST(ExpectedError, APointThatStaysAddsNothingByStaying) {
  ExpectedError error(kMaterial, kDiagonal, kEdge);
  const auto predicted = openings(turning(0.01));
  error.advance_predicted(front(0), predicted);
  const double surface = error.of_surface();
  error.advance_predicted(front(0), predicted);
  EXPECT_EQ(error.of_surface(), surface);
}

TEST(ExpectedError, ASolvedFrameTurnsTheCrackBackFromWhereItIs) {
  ExpectedError error(kMaterial, kDiagonal, kEdge);
  const auto predicted = openings(turning(0.02));
  error.advance_predicted(front(0), predicted);
  const double step = 2 * error.of_surface();
  error.advance_solved(front(1), predicted, {});
  EXPECT_NEAR(error.of_surface(), (0.5 * step + step) / 2, 1e-15);
  // The next stretch begins anew, and adds in quadrature.
  error.advance_predicted(front(2), predicted);
  EXPECT_NEAR(error.of_surface(), (0.5 * step + step + 0.5 * (1 + std::sqrt(2.0)) * step) / 3, 1e-15);
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
