#include "conchoid/bem/tiled_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "conchoid/bem/blas.hpp"
#include "conchoid/core/context.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kSizes[] = {1, 30, TiledCholesky::kTile, TiledCholesky::kTile + 1, 500};

Eigen::MatrixXd random_spd(std::size_t size) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd a(n, n);
  for (double& v : a.reshaped())
    v = uniform(generator);
  return a * a.transpose() + 0.1 * static_cast<double>(size) * Eigen::MatrixXd::Identity(n, n);
}

TiledCholesky filled(const Eigen::MatrixXd& a) {
  TiledCholesky out(static_cast<std::size_t>(a.rows()));
  for (const TiledCholesky::Tile& t : out.tiles())
    Eigen::Map<Eigen::MatrixXd>(t.data, static_cast<Eigen::Index>(t.rows),
                                static_cast<Eigen::Index>(t.columns)) =
        a.block(static_cast<Eigen::Index>(t.row), static_cast<Eigen::Index>(t.column),
                static_cast<Eigen::Index>(t.rows), static_cast<Eigen::Index>(t.columns));
  return out;
}

std::vector<double> entries(TiledCholesky& factor) {
  std::vector<double> all;
  for (const TiledCholesky::Tile& t : factor.tiles())
    all.insert(all.end(), t.data, t.data + t.rows * t.columns);
  return all;
}

}  // namespace

TEST(TiledCholesky, FactorIsThatOfLapack) {
  for (const std::size_t n : kSizes) {
    const Eigen::MatrixXd a = random_spd(n);
    TiledCholesky tiled = filled(a);
    ASSERT_TRUE(tiled.factor());
    Eigen::MatrixXd whole = tiled.scale() * a;
    ASSERT_TRUE(factor_in_place(whole.data(), n, n));
    double worst = 0;
    for (const TiledCholesky::Tile& t : tiled.tiles())
      for (std::size_t j = 0; j < t.columns; ++j)
        for (std::size_t i = t.row == t.column ? j : 0; i < t.rows; ++i)
          worst = std::max(worst,
                           std::abs(t.data[j * t.rows + i] - whole(static_cast<Eigen::Index>(t.row + i),
                                                                   static_cast<Eigen::Index>(t.column + j))));
    EXPECT_LT(worst, 1e-13 * whole.diagonal().maxCoeff()) << n;
  }
}

TEST(TiledCholesky, SolvesAndMultiplies) {
  for (const std::size_t n : kSizes) {
    const Eigen::MatrixXd a = random_spd(n);
    TiledCholesky tiled = filled(a);
    ASSERT_TRUE(tiled.factor());
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.rows(), 3);
    Eigen::MatrixXd x = b;
    tiled.solve_lower(x.data(), 3, n);
    tiled.solve_transposed(x.data(), 3, n);
    x *= tiled.scale();
    EXPECT_LT((a * x - b).norm(), 1e-12 * b.norm()) << n;
    tiled.apply_transposed(x.data(), 3, n);
    tiled.apply_lower(x.data(), 3, n);
    x /= tiled.scale();
    EXPECT_LT((x - b).norm(), 1e-12 * b.norm()) << n;
  }
}

TEST(TiledCholesky, SameBitsForEveryNumberOfThreads) {
  const Eigen::MatrixXd a = random_spd(700);
  std::vector<std::vector<double>> factors;
  for (int threads : {1, 2, 5}) {
    TiledCholesky tiled = filled(a);
    ASSERT_TRUE(ExecutionContext(threads).run([&] { return tiled.factor(); }));
    factors.push_back(entries(tiled));
  }
  EXPECT_EQ(factors[0], factors[1]);
  EXPECT_EQ(factors[0], factors[2]);
}

TEST(TiledCholesky, UnitsDoNotChangeTheDigits) {
  const Eigen::MatrixXd a = random_spd(200);
  TiledCholesky in_pascal = filled(a), in_other = filled(std::ldexp(1.0, 31) * a);
  ASSERT_TRUE(in_pascal.factor());
  ASSERT_TRUE(in_other.factor());
  EXPECT_EQ(entries(in_pascal), entries(in_other));
}

TEST(TiledCholesky, IndefiniteIsRefused) {
  Eigen::MatrixXd a = random_spd(400);
  a(390, 390) = -1;
  EXPECT_FALSE(filled(a).factor());
}

TEST(TiledCholesky, MemoryIsAsStated) {
  for (const std::size_t n : kSizes)
    EXPECT_LE(TiledCholesky(n).bytes(), 4 * n * n + 4 * n * TiledCholesky::kTile);
}

}  // namespace conchoid
