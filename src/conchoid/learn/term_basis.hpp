#pragma once

#include <span>
#include <vector>

#include "conchoid/core/bytes.hpp"
#include "conchoid/learn/features.hpp"

namespace conchoid {

/// Terms of a polynomial in features x: of degree 1 the standardised features (x − mean)/deviation themselves, of
/// degree 2 also the products of any two of them, squares included. Every term is brought to zero mean and unit
/// deviation over the rows it was made from. What does not vary there gives a term of zero.
class TermBasis {
 public:
  TermBasis() = default;
  /// @param rows  at least one @param degree  1 or 2
  TermBasis(const FeatureMatrix& rows, int degree);

  int degree() const { return degree_; }
  std::size_t features() const { return feature_mean_.size(); }
  /// Number of terms.
  std::size_t size() const { return term_mean_.size(); }
  /// Terms of one row. @param z  size() numbers
  void evaluate(std::span<const double> row, std::span<double> z) const;

  void write(ByteWriter& out) const;
  /// Throws InputError if what is read cannot be a basis over so many features of that degree.
  static TermBasis read(ByteReader& in, std::size_t features, int degree);

 private:
  void raw_terms(std::span<const double> row, std::span<double> t) const;

  int degree_ = 1;
  // 1/deviation, 0 where nothing varies
  std::vector<double> feature_mean_, feature_scale_, term_mean_, term_scale_;
};

}  // namespace conchoid
