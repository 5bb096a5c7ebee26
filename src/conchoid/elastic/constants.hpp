#pragma once

namespace conchoid {

/// Isotropic linear elasticity. E [Pa], ν [–]; μ = E / 2(1+ν).
struct ElasticConstants {
  double youngs_modulus = 1;
  double poisson_ratio = 0.3;

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
};

}  // namespace conchoid
