#pragma once

#include "conchoid/sim/scene.hpp"

namespace conchoid::test {

/// A material of round numbers: E 3 GPa, ν 0.3, K_c 1 MPa√m.
inline MaterialSpec glassy() {
  MaterialSpec material;
  material.youngs_modulus = 3e9;
  material.poisson_ratio = 0.3;
  material.toughness = 1e6;
  return material;
}

}  // namespace conchoid::test
