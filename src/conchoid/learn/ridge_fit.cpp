#include "conchoid/learn/ridge_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

using Eigen::MatrixXd;
using Index = Eigen::Index;

constexpr std::size_t kMostGroups = 16;  // of runs that are left out in turn
constexpr double kForOneRun = 1e-6;      // λ where no run can be left out
constexpr int kLargestPower = 0, kSmallestPower = -8;
constexpr std::size_t kBlock = 512;  // rows at a time

std::vector<std::size_t> all_rows(std::size_t n) {
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// Terms and labels of some rows.
struct Block {
  MatrixXd z, y;
};

/// Calls work with the rows, a block at a time and in their order.
template <class Work>
void for_blocks(const TrainingData& data, const TermBasis& basis, const std::vector<std::size_t>& rows,
                Work work) {
  std::vector<double> z(basis.size());
  for (std::size_t begin = 0; begin < rows.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, rows.size() - begin);
    Block block{MatrixXd(count, basis.size()), MatrixXd(count, 3)};
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t row = rows[begin + i];
      basis.evaluate(data.rows.row(row), z);
      const auto at = static_cast<Index>(i);
      block.z.row(at) = Eigen::Map<const Eigen::RowVectorXd>(z.data(), static_cast<Index>(z.size()));
      for (std::size_t mode = 0; mode < 3; ++mode)
        block.y(at, static_cast<Index>(mode)) = data.labels[mode][row];
    }
    work(block);
  }
}

/// Σ z zᵀ (lower triangle), Σ z y and the number of rows.
struct NormalEquations {
  MatrixXd gram, right;
  double rows = 0;

  explicit NormalEquations(std::size_t terms)
      : gram(MatrixXd::Zero(static_cast<Index>(terms), static_cast<Index>(terms))),
        right(MatrixXd::Zero(static_cast<Index>(terms), 3)) {}

  void add(const Block& block) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(block.z.transpose());
    right += block.z.transpose() * block.y;
    rows += static_cast<double>(block.z.rows());
  }
  NormalEquations& operator+=(const NormalEquations& other) {
    gram += other.gram;
    right += other.right;
    rows += other.rows;
    return *this;
  }
  NormalEquations without(const NormalEquations& part) const {
    NormalEquations rest = *this;
    rest.gram -= part.gram;
    rest.right -= part.right;
    rest.rows -= part.rows;
    return rest;
  }
  Eigen::LLT<MatrixXd> factor(double lambda) const {
    MatrixXd a = gram / rows;
    a.diagonal().array() += lambda;
    Eigen::LLT<MatrixXd> llt(a);
    if (llt.info() != Eigen::Success)
      throw ComputationError(
          "the ridge regression could not be solved: its terms depend on each other; give a larger --lambda");
    return llt;
  }
};

NormalEquations normal_equations(const TrainingData& data, const TermBasis& basis,
                                 const std::vector<std::size_t>& rows) {
  NormalEquations equations(basis.size());
  for_blocks(data, basis, rows, [&](const Block& block) { equations.add(block); });
  return equations;
}

/// Rows in groups of whole runs.
std::vector<std::vector<std::size_t>> groups_of_runs(const std::vector<std::int32_t>& run) {
  const std::set<std::int32_t> distinct(run.begin(), run.end());
  const std::vector<std::int32_t> ids(distinct.begin(), distinct.end());
  std::vector<std::vector<std::size_t>> groups(std::min(ids.size(), kMostGroups));
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto place = std::lower_bound(ids.begin(), ids.end(), run[i]) - ids.begin();
    groups[static_cast<std::size_t>(place) % groups.size()].push_back(i);
  }
  return groups;
}

}  // namespace

RidgeFit fit_ridge(const TrainingData& data, const TermBasis& basis, double lambda) {
  const std::vector<std::size_t> rows = all_rows(data.rows.rows());
  const NormalEquations equations = normal_equations(data, basis, rows);
  const Eigen::LLT<MatrixXd> llt = equations.factor(lambda);
  RidgeFit fit;
  fit.beta = llt.solve(equations.right / equations.rows);
  fit.factor = llt.matrixL();
  Vec3 squares = Vec3::Zero();
  for_blocks(data, basis, rows, [&](const Block& block) {
    squares += (block.y - block.z * fit.beta).colwise().squaredNorm().transpose();
  });
  const MatrixXd inverse_factor =
      llt.matrixL().solve(MatrixXd::Identity(fit.factor.rows(), fit.factor.cols()));
  const double used =
      static_cast<double>(basis.size()) - lambda * inverse_factor.squaredNorm();  // tr(1 − λA⁻¹)
  fit.residual = (squares / std::max(1.0, equations.rows - 1 - used)).cwiseSqrt();
  return fit;
}

double choose_lambda(const TrainingData& data, const TermBasis& basis, const std::vector<std::int32_t>& run) {
  const auto groups = groups_of_runs(run);
  if (groups.size() < 2) return kForOneRun;
  std::vector<double> lambdas;
  for (int power = kLargestPower; power >= kSmallestPower; --power)
    lambdas.push_back(std::pow(10.0, power));
  std::vector<NormalEquations> parts(groups.size(), NormalEquations(0));
  parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g)
      parts[g] = normal_equations(data, basis, groups[g]);
  });
  NormalEquations all(basis.size());
  for (const NormalEquations& part : parts)
    all += part;
  std::vector<std::vector<double>> errors(groups.size(), std::vector<double>(lambdas.size(), 0));
  parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const NormalEquations rest = all.without(parts[g]);
      std::vector<MatrixXd> betas;
      for (const double lambda : lambdas)
        betas.push_back(rest.factor(lambda).solve(rest.right / rest.rows));
      for_blocks(data, basis, groups[g], [&](const Block& block) {
        for (std::size_t l = 0; l < lambdas.size(); ++l)
          errors[g][l] += (block.y - block.z * betas[l]).squaredNorm();
      });
    }
  });
  std::size_t best = 0;
  std::vector<double> total(lambdas.size(), 0);
  for (std::size_t l = 0; l < lambdas.size(); ++l) {
    for (const auto& of_group : errors)
      total[l] += of_group[l];
    if (total[l] < total[best]) best = l;
  }
  return lambdas[best];
}

}  // namespace conchoid
