#pragma once

#include <span>
#include <vector>

namespace conchoid {

/// What the spread that a regressor states is worth: the error that samples which it has not seen really had, where that
/// much was stated. Piecewise linear in the logarithms of both between the knots and never falling; below the first knot
/// its error, above the last one in proportion. Without knots a spread is what is stated.
class SpreadCalibration {
 public:
  struct Knot {
    double stated = 0;  ///< > 0, rising
    double found = 0;   ///< root mean square error there, > 0, never falling
    bool operator==(const Knot&) const = default;
  };

  SpreadCalibration() = default;
  /// Throws InputError if the knots are not as they have to be.
  explicit SpreadCalibration(std::vector<Knot> knots);

  /// Ten groups of equal size by what is stated, fewer where a group would have less than fifty samples; a knot is the root
  /// mean square of either in its group, that of the errors no less than in the group before. Samples that nothing is
  /// stated of say nothing. Throws InputError if less than fifty are left, or no error is above zero.
  /// @param stated, errors  one per sample, in the same unit
  static SpreadCalibration measure(std::span<const double> stated, std::span<const double> errors);

  double operator()(double stated) const;
  const std::vector<Knot>& knots() const { return knots_; }
  bool empty() const { return knots_.empty(); }
  bool operator==(const SpreadCalibration&) const = default;

 private:
  std::vector<Knot> knots_;
};

}  // namespace conchoid
