#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace conchoid {

/// Largest relative error of a single operation.
inline constexpr double unit_roundoff = 0.5 * std::numeric_limits<double>::epsilon();

/// Exact real number as a sum of doubles that do not overlap, in increasing magnitude, without zeros
/// (Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997).
/// Exact as long as nothing over- or underflows. Slow: used only where rounding leaves a sign open.
class Expansion {
 public:
  Expansion() = default;
  Expansion(double value) {
    if (value != 0) push(value);
  }

  /// a − b, exactly.
  static Expansion difference(double a, double b) {
    const double d = a - b;
    const double b_virtual = a - d;
    const double a_virtual = d + b_virtual;
    Expansion e;
    const double low = (a - a_virtual) + (b_virtual - b);
    if (low != 0) e.push(low);
    if (d != 0) e.push(d);
    return e;
  }

  bool is_zero() const { return size_ == 0; }
  int sign() const { return size_ == 0 ? 0 : data()[size_ - 1] > 0 ? 1 : -1; }
  /// Nearest double to within an ulp or so.
  double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i)
      sum += data()[i];
    return sum;
  }

  Expansion operator-() const {
    Expansion r = *this;
    for (std::size_t i = 0; i < size_; ++i)
      r.data()[i] = -r.data()[i];
    return r;
  }

  Expansion& operator+=(const Expansion& other) {
    for (std::size_t i = 0; i < other.size_; ++i)
      grow(other.data()[i]);
    return *this;
  }
  friend Expansion operator+(Expansion a, const Expansion& b) { return a += b; }
  friend Expansion operator-(Expansion a, const Expansion& b) { return a += -b; }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion product;
    for (std::size_t i = 0; i < a.size_; ++i)
      for (std::size_t j = 0; j < b.size_; ++j) {
        const double x = a.data()[i], y = b.data()[j];
        const double p = x * y;
        const double error = std::fma(x, y, -p);
        if (error != 0) product.grow(error);
        if (p != 0) product.grow(p);
      }
    return product;
  }

 private:
  static constexpr std::size_t inline_size = 8;

  double* data() { return large_.empty() ? small_.data() : large_.data(); }
  const double* data() const { return large_.empty() ? small_.data() : large_.data(); }

  void push(double value) {
    if (!large_.empty()) {
      large_.resize(size_);
      large_.push_back(value);
    } else if (size_ == inline_size) {
      large_.assign(small_.begin(), small_.end());
      large_.push_back(value);
    } else {
      small_[size_] = value;
    }
    ++size_;
  }

  /// Adds one double; drops zeros.
  void grow(double value) {
    double carry = value;
    std::size_t out = 0;
    double* terms = data();
    for (std::size_t i = 0; i < size_; ++i) {
      const double t = terms[i];
      const double sum = carry + t;
      const double t_virtual = sum - carry;
      const double error = (carry - (sum - t_virtual)) + (t - t_virtual);
      carry = sum;
      if (error != 0) terms[out++] = error;
    }
    size_ = out;
    if (carry != 0) push(carry);
  }

  std::array<double, inline_size> small_;
  std::vector<double> large_;  ///< takes over when the inline terms do not suffice; never given back
  std::size_t size_ = 0;
};

}  // namespace conchoid
