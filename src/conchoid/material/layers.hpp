#pragma once

#include "conchoid/material/field_sample.hpp"

namespace conchoid {

/// Sine layers: 1 + a sin 2π(n·x/λ − φ). Bedding, plies, growth rings.
struct Layers {
  Vec3 direction = Vec3::UnitZ();  ///< n, unit: across the layers
  double wavelength = 1;           ///< λ [m], > 0
  double amplitude = 0;            ///< a, 0 … 1 (1 excluded)
  double phase = 0;                ///< φ [wavelengths]

  FieldSample at(const Vec3& x) const;
};

}  // namespace conchoid
