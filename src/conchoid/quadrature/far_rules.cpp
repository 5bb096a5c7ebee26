#include "conchoid/quadrature/far_rules.hpp"

#include <array>
#include <cmath>

namespace conchoid {

namespace {

/// error ≤ factor · (radius/distance)^(degree+1). The factors are the largest ones met over random panel
/// pairs.
struct DegreeBound {
  int degree;
  double factor;
};
constexpr std::array<DegreeBound, 7> bounds = {
    {{2, 1.0}, {4, 1.0}, {5, 1.0}, {6, 1.0}, {8, 1.0}, {10, 1.0}, {12, 1.0}}};

}  // namespace

int far_degree(double radius, double distance, double tolerance) {
  if (!(distance > radius)) return 0;
  const double ratio = radius / distance;
  for (const DegreeBound& bound : bounds) {
    double power = bound.factor;
    for (int k = 0; k <= bound.degree; ++k)
      power *= ratio;
    if (power <= tolerance) return bound.degree;
  }
  return 0;
}

}  // namespace conchoid
