#include "conchoid/quadrature/far_rules.hpp"

#include <array>
#include <cmath>

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
constexpr std::array<DegreeBound, 7> bounds = {{{2, 0.033, 0.18},
                                                {4, 0.0096, 0.075},
                                                {5, 0.0125, 0.16},
                                                {6, 0.0015, 0.007},
                                                {8, 0.0018, 0.0035},
                                                {10, 7e-5, 3.5e-4},
                                                {12, 1.6e-5, 7e-5}}};

}  // namespace

int far_degree(Layer layer, double radius, double distance, double tolerance, int density) {
  if (!(distance > radius)) return 0;
  const double r = radius / distance, r2 = r * r, r3 = r2 * r, r5 = r3 * r2, r6 = r3 * r3;
  const std::array<double, bounds.size()> power = {r3, r5, r6, r5 * r2, r6 * r3, r6 * r5, r6 * r5 * r2};
  for (; density > 0; --density)
    tolerance *= r;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (power[i] * (layer == Layer::single ? bounds[i].single : bounds[i].dbl) <= tolerance)
      return bounds[i].degree;
  return 0;
}

}  // namespace conchoid
