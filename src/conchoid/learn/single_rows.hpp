#pragma once

#include <span>
#include <vector>

namespace conchoid {

/// To single precision, as trees compare it, without leaving its range.
std::vector<float> single_rows(std::span<const double> values);

}  // namespace conchoid
