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
  int degree(Layer layer, double radius, double distance) const;

 private:
  static constexpr std::size_t kRules = 9;
  std::array<std::array<double, kRules>, 2> largest_;  ///< radius/distance for each rule, of either layer
};

}  // namespace conchoid
