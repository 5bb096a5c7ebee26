#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/core/module.hpp"
#include "conchoid/learn/bagging.hpp"
#include "conchoid/learn/boosting.hpp"

namespace conchoid {

constexpr Module kTreeModule{"conchoid_trees", "XGBoost", "CONCHOID_WITH_LEARNING"};

/// Fits trees to weighted samples of the same rows. May be called from several threads.
class TreeGrower {
 public:
  virtual ~TreeGrower() = default;
  /// @param counts      how often every sample counts
  /// @param prediction  if given: XGBoost's own for every row
  virtual RegressionTree grow(const std::vector<float>& values, const std::vector<std::uint32_t>& counts,
                              std::vector<float>* prediction) = 0;
  /// Trees whose sum is the answer, until it stops getting better for the rows that are left out.
  /// @param left_out  per row, whether it is not learned from; none may be: then all rounds are made
  virtual std::vector<RegressionTree> boost(const std::vector<float>& values,
                                            const std::vector<char>& left_out,
                                            const BoostingSettings& settings) = 0;
};

/// @param rows  must outlive the grower
using MakeTreeGrower = void(std::span<const float> rows, std::size_t columns, const BaggingSettings& settings,
                            std::unique_ptr<TreeGrower>& grower);

}  // namespace conchoid
