#include "conchoid/learn/single_rows.hpp"

#include <algorithm>
#include <limits>

namespace conchoid {

std::vector<float> single_rows(std::span<const double> values) {
  constexpr double limit = std::numeric_limits<float>::max();
  std::vector<float> rows(values.size());
  std::transform(values.begin(), values.end(), rows.begin(),
                 [limit](double value) { return static_cast<float>(std::clamp(value, -limit, limit)); });
  return rows;
}

std::vector<float> single_rows(const FeatureMatrix& rows, std::size_t begin, std::size_t end) {
  return single_rows(std::span(rows.values).subspan(begin * rows.columns, (end - begin) * rows.columns));
}

}  // namespace conchoid
