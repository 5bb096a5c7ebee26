#include "conchoid/elastic/kelvin.hpp"

#include <cmath>
#include <numbers>

namespace conchoid {

Mat3 kelvin_displacement(const Vec3& d, const ElasticConstants& m) {
  const double r = d.norm();
  const Vec3 e = d / r;
  const double c = 1.0 / (16 * std::numbers::pi * m.shear_modulus() * (1 - m.poisson_ratio) * r);
  return c * ((3 - 4 * m.poisson_ratio) * Mat3::Identity() + e * e.transpose());
}

}  // namespace conchoid
