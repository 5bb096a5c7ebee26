#include "conchoid/bem/bordered_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

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

std::vector<double> rows(const Eigen::MatrixXd& a, int first, int count, int first_column, int columns) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < columns; ++j)
      out.push_back(a(first + i, first_column + j));
  return out;
}

}  // namespace

TEST(BorderedCholesky, GrownInStepsSolvesLikeTheWhole) {
  const Eigen::MatrixXd a = random_spd(47);
  BorderedCholesky factor;
  for (const auto& [first, count] : {std::pair{0, 20}, {20, 1}, {21, 13}, {34, 13}})
    ASSERT_TRUE(factor.append(rows(a, first, count, 0, first), rows(a, first, count, first, count)));
  Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(47, -1, 2);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}

TEST(BorderedCholesky, TruncatedAndGrownAgainIsTheSame) {
  const Eigen::MatrixXd a = random_spd(30);
  BorderedCholesky factor;
  ASSERT_TRUE(factor.append({}, rows(a, 0, 30, 0, 30)));
  factor.truncate(11);
  ASSERT_TRUE(factor.append(rows(a, 11, 19, 0, 11), rows(a, 11, 19, 11, 19)));
  Eigen::VectorXd b = Eigen::VectorXd::Ones(30);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}

TEST(BorderedCholesky, IndefiniteBorderIsRefusedAndLeavesTheFactor) {
  const Eigen::MatrixXd a = random_spd(10);
  BorderedCholesky factor;
  ASSERT_TRUE(factor.append({}, rows(a, 0, 10, 0, 10)));
  std::vector<double> coupling(10, 0.0);
  EXPECT_FALSE(factor.append(coupling, {-1.0}));
  EXPECT_EQ(factor.size(), 10u);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  const Eigen::VectorXd exact = a.llt().solve(b);
  factor.solve(b.data());
  EXPECT_LT((b - exact).norm(), 1e-13 * exact.norm());
}
