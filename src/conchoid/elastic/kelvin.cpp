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

Mat3 kelvin_stress(const Vec3& d, const Vec3& force, const ElasticConstants& m) {
  const double r = d.norm();
  const Vec3 e = d / r;
  const double nu = m.poisson_ratio, a = 1 - 2 * nu, fe = force.dot(e);
  const double c = 1 / (8 * std::numbers::pi * (1 - nu) * r * r);
  return c * (a * (force * e.transpose() + e * force.transpose() - fe * Mat3::Identity()) +
              3 * fe * e * e.transpose());
}

Mat3 kelvin_dislocation_stress(const Vec3& d, const Vec3& n, const Vec3& w, const ElasticConstants& m) {
  const double r = d.norm();
  const Vec3 e = d / r;
  const double nu = m.poisson_ratio, a = 1 - 2 * nu, en = e.dot(n), we = w.dot(e), wn = w.dot(n);
  const double c = m.shear_modulus() / (4 * std::numbers::pi * (1 - nu) * r * r * r);
  const auto symmetric = [](const Vec3& p, const Vec3& q) -> Mat3 {
    return p * q.transpose() + q * p.transpose();
  };
  const Mat3 I = Mat3::Identity();
  return c * (3 * en * (a * we * I + nu * symmetric(w, e) - 5 * we * e * e.transpose()) +
              3 * nu * we * symmetric(n, e) + a * (3 * wn * e * e.transpose() + symmetric(n, w)) -
              (1 - 4 * nu) * wn * I);
}

}  // namespace conchoid
