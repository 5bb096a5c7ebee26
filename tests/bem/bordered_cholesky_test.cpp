#include "conchoid/bem/bordered_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <utility>
#include <vector>

using namespace conchoid;

namespace {

Eigen::MatrixXd random_spd(int n) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd a(n, n);
  for (double& v : a.reshaped())
    v = uniform(generator);
  return a * a.transpose() + n * Eigen::MatrixXd::Identity(n, n);
}

/// Appends rows first … first + count of A, up to the diagonal.
bool append(BorderedCholesky& factor, const Eigen::MatrixXd& a, int first, int count) {
  std::vector<std::vector<double>> rows;
  for (int i = first; i < first + count; ++i) {
    const Eigen::VectorXd row = a.row(i).head(i + 1);
    rows.emplace_back(row.begin(), row.end());
  }
  return factor.append(rows.size(), [&](std::size_t i) { return rows[i].data(); });
}

}  // namespace

TEST(BorderedCholesky, GrownInStepsSolvesLikeTheWhole) {
  const Eigen::MatrixXd a = random_spd(147);
  BorderedCholesky factor;
  for (const auto& [first, count] : {std::pair{0, 20}, {20, 1}, {21, 13}, {34, 113}})
    ASSERT_TRUE(append(factor, a, first, count));
  Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(147, -1, 2);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}

TEST(BorderedCholesky, TruncatedAndGrownAgainIsTheSame) {
  const Eigen::MatrixXd a = random_spd(30);
  BorderedCholesky factor;
  ASSERT_TRUE(append(factor, a, 0, 30));
  factor.truncate(11);
  ASSERT_TRUE(append(factor, a, 11, 19));
  Eigen::VectorXd b = Eigen::VectorXd::Ones(30);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}

TEST(BorderedCholesky, IndefiniteBorderIsRefusedAndLeavesTheFactor) {
  const Eigen::MatrixXd a = random_spd(10);
  BorderedCholesky factor;
  ASSERT_TRUE(append(factor, a, 0, 10));
  std::vector<double> row(11, 0.0);
  row.back() = -1;
  EXPECT_FALSE(factor.append(1, [&](std::size_t) { return row.data(); }));
  EXPECT_EQ(factor.size(), 10u);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}
