#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "conchoid/learn/run_groups.hpp"
#include "conchoid/learn/tree_ensemble.hpp"

namespace conchoid {

struct BoostingSettings {
  int trees = 300;     ///< at most, per member, ≥ 1
  int depth = 6;       ///< maximal depth, 1 … 20
  double rate = 0.1;   ///< share of its own answer that a tree gives, 0 … 1
  int leaf = 20;       ///< least number of samples in a leaf, ≥ 1
  double penalty = 1;  ///< on the square of a leaf's value, in samples
  int bins = 256;      ///< candidate thresholds per feature (quantiles), 2 … 65536
  int patience = 20;   ///< rounds without gain on what is left out, after which no more are made
};

/// One member of an ensemble: trees whose *sum* is its answer, fitted to one target.
using BoostedMember = std::vector<RegressionTree>;

/// Gradient boosting (Friedman, Annals of Statistics 2001) for squared errors: every tree is fitted to what the sum of
/// those before it leaves. Members are fitted to all samples but one group each, on which the number of trees is chosen.
/// Trees by XGBoost, one thread each: the same bits for every number of threads.
/// @param rows      features, row after row, finite
/// @param targets   one value per sample each, best of zero mean and unit deviation
/// @param groups    one only: one member of all samples, all of its trees
/// @param progress  called after every member, never twice at a time; may throw to stop
/// @return per target, per member
std::vector<std::vector<BoostedMember>> fit_boosted_trees(std::span<const float> rows, std::size_t columns,
                                                          const std::vector<std::vector<float>>& targets,
                                                          const RunGroups& groups,
                                                          const BoostingSettings& settings,
                                                          const std::function<void()>& progress = {});

}  // namespace conchoid
