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
  const double ratio = radius / distance;
  double power = ratio;
  for (; density > 0; --density)
    power /= ratio;
  int degree = 0;
  for (const DegreeBound& bound : bounds) {
    for (; degree < bound.degree; ++degree)
      power *= ratio;
    if (power * (layer == Layer::single ? bound.single : bound.dbl) <= tolerance) return bound.degree;
  }
  return 0;
}

}  // namespace conchoid
