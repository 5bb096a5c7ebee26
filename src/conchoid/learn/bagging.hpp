#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "conchoid/learn/tree_ensemble.hpp"

namespace conchoid {

/// How often each of n samples is drawn in n draws with replacement. Portable: the same on every machine for
/// a seed.
std::vector<std::uint32_t> bootstrap_counts(std::size_t n, std::uint64_t seed);

/// Seed of the stream (seed, a, b): independent streams for every tree of every mode.
std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t a, std::uint64_t b);

struct BaggingSettings {
  int trees = 50;  ///< ≥ 1
  int depth = 10;  ///< maximal depth, 1 … 20
  std::uint64_t seed = 1;
  int bins = 256;  ///< candidate thresholds per feature (quantiles), 2 … 65536
  int leaf = 1;    ///< least number of samples in a leaf, with multiplicity, ≥ 1
};

/// One target per sample to be learned from rows of features.
struct BaggingTarget {
  std::vector<float> values;  ///< best of zero mean and unit deviation: XGBoost ignores gains below 1e-6
  std::uint64_t stream = 0;   ///< distinguishes the random numbers of several targets
};

/// Trees of a regression forest, each fitted by least squares to its own bootstrap sample (Breiman 1996): a
/// node's value is the mean of its samples counted with multiplicity, a split is the one that lowers the sum
/// of squared deviations most. Fitted by XGBoost: gradient −count·y and hessian count without regularisation
/// make a boosting round from zero exactly that.
/// Trees are independent jobs of one thread each: they have the same bits for every number of threads, and a
/// busy machine does not make threads wait for one another.
/// @param rows      features, row after row, finite
/// @param progress  called after every tree, never twice at a time; may throw to stop
/// @param predictions  if given: XGBoost's own mean prediction for every row and target, the slow oracle of
/// TreeEnsemble
/// @return the trees of every target
std::vector<std::vector<RegressionTree>> fit_bagged_trees(
    std::span<const float> rows, std::size_t columns, const std::vector<BaggingTarget>& targets,
    const BaggingSettings& settings, const std::function<void()>& progress = {},
    std::vector<std::vector<float>>* predictions = nullptr);

}  // namespace conchoid
