#pragma once

#include <span>
#include <vector>

#include "conchoid/learn/features.hpp"

namespace conchoid {

/// To single precision, as trees compare it, without leaving its range.
std::vector<float> single_rows(std::span<const double> values);
/// Rows begin … end.
std::vector<float> single_rows(const FeatureMatrix& rows, std::size_t begin, std::size_t end);

}  // namespace conchoid
