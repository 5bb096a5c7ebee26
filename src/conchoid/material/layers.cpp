#include "conchoid/material/layers.hpp"

#include <cmath>
#include <numbers>

namespace conchoid {

FieldSample Layers::at(const Vec3& x) const {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double along = direction.dot(x) / wavelength - phase;
  const double angle = kTurn * (along - std::floor(along));
  return {1 + amplitude * std::sin(angle), (kTurn * amplitude * std::cos(angle) / wavelength) * direction};
}

}  // namespace conchoid
