#include "conchoid/learn/term_basis.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr double kConstant = 1e-12;  // × the largest value: what varies less is round-off

std::size_t term_count(std::size_t features, int degree) {
  return degree == 1 ? features : features + features * (features + 1) / 2;
}

// Mean and 1/deviation of `count` columns over n rows; fill(i, t) gives row i.
template <class Fill>
void standardise(std::size_t n, std::size_t count, std::vector<double>& mean, std::vector<double>& scale,
                 Fill fill) {
  mean.assign(count, 0);
  scale.assign(count, 0);
  std::vector<double> t(count), largest(count, 0);
  for (std::size_t i = 0; i < n; ++i) {
    fill(i, t);
    for (std::size_t k = 0; k < count; ++k) {
      mean[k] += t[k];
      largest[k] = std::max(largest[k], std::abs(t[k]));
    }
  }
  for (double& m : mean)
    m /= static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    fill(i, t);
    for (std::size_t k = 0; k < count; ++k)
      scale[k] += (t[k] - mean[k]) * (t[k] - mean[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double deviation = std::sqrt(scale[k] / static_cast<double>(n));
    scale[k] = deviation > kConstant * largest[k] ? 1 / deviation : 0;
  }
}

}  // namespace

TermBasis::TermBasis(const FeatureMatrix& rows, int degree) : degree_(degree) {
  standardise(
      rows.rows(), rows.columns, feature_mean_, feature_scale_,
      [&](std::size_t i, std::vector<double>& t) { std::copy_n(rows.row(i).begin(), t.size(), t.begin()); });
  standardise(rows.rows(), term_count(rows.columns, degree), term_mean_, term_scale_,
              [&](std::size_t i, std::vector<double>& t) { raw_terms(rows.row(i), t); });
}

void TermBasis::raw_terms(std::span<const double> row, std::span<double> t) const {
  std::size_t n = features();
  for (std::size_t j = 0; j < n; ++j)
    t[j] = (row[j] - feature_mean_[j]) * feature_scale_[j];
  if (degree_ == 1) return;
  const std::size_t linear = n;
  for (std::size_t j = 0; j < linear; ++j)
    for (std::size_t k = j; k < linear; ++k)
      t[n++] = t[j] * t[k];
}

void TermBasis::evaluate(std::span<const double> row, std::span<double> z) const {
  raw_terms(row, z);
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = (z[k] - term_mean_[k]) * term_scale_[k];
}

void TermBasis::write(ByteWriter& out) const {
  for (const auto* numbers : {&feature_mean_, &feature_scale_, &term_mean_, &term_scale_})
    out.put_all(std::span<const double>(*numbers));
}

TermBasis TermBasis::read(ByteReader& in, std::size_t features, int degree) {
  if (degree != 1 && degree != 2) throw InputError("the degree is neither 1 nor 2");
  const std::size_t terms = term_count(features, degree);
  TermBasis basis;
  basis.degree_ = degree;
  basis.feature_mean_ = in.get_all<double>(features);
  basis.feature_scale_ = in.get_all<double>(features);
  basis.term_mean_ = in.get_all<double>(terms);
  basis.term_scale_ = in.get_all<double>(terms);
  for (const auto* numbers :
       {&basis.feature_mean_, &basis.feature_scale_, &basis.term_mean_, &basis.term_scale_})
    if (!std::all_of(numbers->begin(), numbers->end(), [](double v) { return std::isfinite(v); }))
      throw InputError("a term is not finite");
  return basis;
}

}  // namespace conchoid
