#pragma once

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// A material field at a point: the factor on the material's constant there, and how it changes.
struct FieldSample {
  double value = 1;              ///< > 0
  Vec3 gradient = Vec3::Zero();  ///< of the value [1/m]
};

}  // namespace conchoid
