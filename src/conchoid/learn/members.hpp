#pragma once

#include <algorithm>
#include <cmath>

namespace conchoid {

/// Answers of the g members of an ensemble, each fitted without one of g groups of runs: their mean, and as its
/// standard deviation the jackknife's with groups left out (Efron & Stein, Annals of Statistics 1981),
/// √((g − 1)/g Σ (x_i − x̄)²).
class MemberAnswers {
 public:
  void add(double answer) {
    count_ += 1;
    sum_ += answer;
    square_ += answer * answer;
  }
  double mean() const { return sum_ / count_; }
  double spread() const {
    return std::sqrt(std::max(0.0, (count_ - 1) / count_ * (square_ - sum_ * mean())));
  }

 private:
  double count_ = 0, sum_ = 0, square_ = 0;
};

}  // namespace conchoid
