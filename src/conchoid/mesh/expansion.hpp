#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace conchoid {

/// Exact real number as a sum of doubles that do not overlap, in increasing magnitude, without zeros
/// (Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997).
/// Exact as long as nothing over- or underflows. Slow: used only where rounding leaves a sign open.
class Expansion {
 public:
  Expansion() = default;
  Expansion(double value) {
    if (value != 0) terms_.push_back(value);
  }

  /// a − b, exactly.
  static Expansion difference(double a, double b) {
    const double d = a - b;
    const double b_virtual = a - d;
    const double a_virtual = d + b_virtual;
    return pair(d, (a - a_virtual) + (b_virtual - b));
  }

  bool is_zero() const { return terms_.empty(); }
  int sign() const { return terms_.empty() ? 0 : terms_.back() > 0 ? 1 : -1; }
  /// Nearest double to within an ulp or so.
  double estimate() const {
    double sum = 0;
    for (const double t : terms_)
      sum += t;
    return sum;
  }

  Expansion operator-() const {
    Expansion r = *this;
    for (double& t : r.terms_)
      t = -t;
    return r;
  }

  Expansion& operator+=(const Expansion& other) {
    for (const double t : other.terms_)
      grow(t);
    return *this;
  }
  friend Expansion operator+(Expansion a, const Expansion& b) { return a += b; }
  friend Expansion operator-(Expansion a, const Expansion& b) { return a += -b; }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion product;
    for (const double x : a.terms_)
      for (const double y : b.terms_) {
        const double p = x * y;
        const double error = std::fma(x, y, -p);
        if (error != 0) product.grow(error);
        if (p != 0) product.grow(p);
      }
    return product;
  }

 private:
  static Expansion pair(double high, double low) {
    Expansion e;
    if (low != 0) e.terms_.push_back(low);
    if (high != 0) e.terms_.push_back(high);
    return e;
  }

  /// Adds one double; drops zeros.
  void grow(double value) {
    double carry = value;
    std::size_t out = 0;
    for (const double t : terms_) {
      const double sum = carry + t;
      const double t_virtual = sum - carry;
      const double error = (carry - (sum - t_virtual)) + (t - t_virtual);
      carry = sum;
      if (error != 0) terms_[out++] = error;
    }
    terms_.resize(out);
    if (carry != 0) terms_.push_back(carry);
  }

  std::vector<double> terms_;
};

}  // namespace conchoid
