#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/core/module.hpp"
#include "conchoid/learn/bagging.hpp"

namespace conchoid {

constexpr Module kTreeModule{"conchoid_trees", "XGBoost", "CONCHOID_WITH_LEARNING"};

/// Fits single trees to weighted samples of the same rows. May be called from several threads.
class TreeGrower {
 public:
  virtual ~TreeGrower() = default;
  /// @param counts      how often every sample counts
  /// @param prediction  if given: XGBoost's own for every row
  virtual RegressionTree grow(const std::vector<float>& values, const std::vector<std::uint32_t>& counts,
                              std::vector<float>* prediction) = 0;
};

/// @param rows  must outlive the grower
using MakeTreeGrower = void(std::span<const float> rows, std::size_t columns, const BaggingSettings& settings,
                            std::unique_ptr<TreeGrower>& grower);

}  // namespace conchoid
