#include "conchoid/bem/bordered_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <utility>

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

/// Appends rows first … first + count of A; what is above the diagonal is not to be read.
bool append(BorderedCholesky& factor, const Eigen::MatrixXd& a, int first, int count) {
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> rows = a.middleRows(first, count);
  for (int i = 0; i < count; ++i)
    rows.row(i).tail(a.cols() - first - i - 1).setConstant(std::nan(""));
  return factor.append(rows.data(), static_cast<std::size_t>(a.cols()), static_cast<std::size_t>(count));
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
  EXPECT_FALSE(factor.append(row.data(), 11, 1));
  EXPECT_EQ(factor.size(), 10u);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}
