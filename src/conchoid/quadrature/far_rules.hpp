#pragma once

#include <array>

namespace conchoid {

/// Which layer's kernel: the double layer varies faster.
enum class Layer { single, dbl };

/// Lowest degree of a triangle rule that integrates the layer's potential over a panel of that radius to the
/// relative tolerance, when no source is closer to the panel's center than `distance`; 0 when no rule does.
/// @param density  degree of a polynomial that the potential is multiplied by: it takes as much from the rule's
int far_degree(Layer layer, double radius, double distance, double tolerance, int density = 0);

/// far_degree() for one tolerance, without a density, by comparisons alone.
class FarLimits {
 public:
  explicit FarLimits(double tolerance);
  int degree(Layer layer, double radius, double distance) const {
    if (!(distance > radius)) return 0;
    const double r = radius / distance;
    std::size_t too_small = 0;  // rules: all that come before the one that is enough
    for (const double largest : largest_[static_cast<std::size_t>(layer)])
      too_small += static_cast<std::size_t>(r > largest);
    return kDegrees[too_small];
  }

 private:
  static constexpr std::size_t kRules = 9;
  static constexpr std::array<int, kRules + 1> kDegrees{2, 4, 5, 6, 8, 9, 10, 11, 12, 0};
  std::array<std::array<double, kRules>, 2> largest_;  ///< radius/distance for each rule, of either layer
};

}  // namespace conchoid
