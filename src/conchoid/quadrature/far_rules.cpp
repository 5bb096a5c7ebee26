#include "conchoid/quadrature/far_rules.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace conchoid {

namespace {

/// error ≤ factor · (radius/distance)^(degree+1), relative to the pair's ∫∫1/R, or for the double layer to
/// area·area/distance². The factors were measured: the largest over 6000 random pairs (normal corner
/// coordinates; a half thinned to 0.3 and to 0.03 of their height; sizes 1/3 … 3 of each other;
/// radius/distance 0.05 … 0.85), rules over one panel with the closed form over the other and rules over
/// both, against the closed form over cells small enough for 1e-14; then rounded up by a quarter.
struct DegreeBound {
  int degree;
  double single, dbl;
};
constexpr std::array<DegreeBound, 9> bounds = {{{2, 0.033, 0.18},
                                                {4, 0.0096, 0.075},
                                                {5, 0.0125, 0.16},
                                                {6, 0.0015, 0.007},
                                                {8, 0.0018, 0.0035},
                                                {9, 4.8e-4, 2.6e-3},
                                                {10, 7e-5, 3.5e-4},
                                                {11, 6e-5, 2.5e-4},
                                                {12, 1.6e-5, 7e-5}}};

double factor(const DegreeBound& bound, Layer layer) {
  return layer == Layer::single ? bound.single : bound.dbl;
}

/// rᵈ⁺¹ for the degrees d of the rules.
std::array<double, bounds.size()> powers(double r) {
  const double r2 = r * r, r3 = r2 * r, r5 = r3 * r2, r6 = r3 * r3, r11 = r6 * r5;
  return {r3, r5, r6, r5 * r2, r6 * r3, r5 * r5, r11, r6 * r6, r11 * r2};
}

/// The largest number of 0 … 1 for which a property holds that all smaller ones have, 0 among them.
template <class Holds>
double largest_with(const Holds& holds) {
  auto low = std::bit_cast<std::uint64_t>(0.0), high = std::bit_cast<std::uint64_t>(1.0);
  if (holds(1.0)) return 1;
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (holds(std::bit_cast<double>(middle)) ? low : high) = middle;
  }
  return std::bit_cast<double>(low);
}

}  // namespace

int far_degree(Layer layer, double radius, double distance, double tolerance, int density) {
  if (!(distance > radius)) return 0;
  const double r = radius / distance;
  const auto power = powers(r);
  for (; density > 0; --density)
    tolerance *= r;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (power[i] * factor(bounds[i], layer) <= tolerance) return bounds[i].degree;
  return 0;
}

FarLimits::FarLimits(double tolerance) {
  static_assert(kRules == bounds.size() && kDegrees[kRules] == 0);
  static_assert(std::equal(bounds.begin(), bounds.end(), kDegrees.begin(),
                           [](const DegreeBound& b, int degree) { return b.degree == degree; }));
  for (const Layer layer : {Layer::single, Layer::dbl})
    for (std::size_t i = 0; i < kRules; ++i) {
      double& largest = largest_[static_cast<std::size_t>(layer)][i];
      largest = largest_with([&](double r) { return powers(r)[i] * factor(bounds[i], layer) <= tolerance; });
      if (i > 0) largest = std::max(largest, largest_[static_cast<std::size_t>(layer)][i - 1]);
    }
}

}  // namespace conchoid
