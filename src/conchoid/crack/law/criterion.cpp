#include "conchoid/crack/law/criterion.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// Angle of the stationary hoop intensity that belongs to the sign of `opening`; written so that small K_II
/// loses no digits: (k − √(k² + 8 K_II²)) / (4 K_II) = −2 K_II / (k + √(k² + 8 K_II²)).
double stationary_angle(double opening, double sliding) {
  const double root = std::sqrt(opening * opening + 8 * sliding * sliding);
  const double denominator = opening + root;
  return denominator > 0 ? 2 * std::atan(-2 * sliding / denominator) : 0.0;
}

}  // namespace

Vec3 with_closed_faces(const Vec3& K) {
  return {std::max(K[0], 0.0), K[1], K[2]};
}

double effective_intensity(const Vec3& K, const ElasticConstants& m) {
  const Vec3 k = with_closed_faces(K);
  return std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2] / (1 - m.poisson_ratio));
}

double kink_angle(const Vec3& K, const ElasticConstants& m) {
  const Vec3 k = with_closed_faces(K);
  if (k[1] == 0) return 0;
  return stationary_angle(std::sqrt(k[0] * k[0] + k[2] * k[2] / (1 - m.poisson_ratio)), k[1]);
}

std::array<double, 2> kinking_intensity(double angle) {
  const double opened = 3 * std::cos(angle) - 1;
  if (opened <= 0) return {0, std::copysign(1.0, -angle)};
  const double slid = -std::sin(angle), size = std::hypot(opened, slid);
  return {opened / size, slid / size};
}

double hoop_intensity(const Vec3& K, double angle) {
  const double c = std::cos(angle / 2);
  return c * (K[0] * c * c - 1.5 * K[1] * std::sin(angle));
}

Vec3 with_compressive_factor(const Vec3& K, double factor) {
  // The extremes over θ: the stationary points of K (tension) and of −K (compression), and the faces (θ =
  // ±π), where σ_θθ = 0.
  const Vec3 reversed = -K;
  double tension = 0, compression = 0;
  for (double sign : {1.0, -1.0}) {
    const double angle = stationary_angle(sign * K[0], sign * K[1]);
    tension = std::max(tension, hoop_intensity(K, angle));
    compression = std::max(compression, hoop_intensity(reversed, angle));
  }
  return compression > factor * tension ? Vec3(reversed / factor) : K;
}

double rayleigh_speed(const ElasticConstants& m, double density, RayleighFormula formula) {
  const double shear_speed = std::sqrt(m.shear_modulus() / density);
  if (formula == RayleighFormula::published) return 0.9 * shear_speed;
  const double eta = (1 - 2 * m.poisson_ratio) / (2 - 2 * m.poisson_ratio);
  // Squared and divided by ξ²: x³ − 8x² + (24 − 16η) x − 16 (1 − η) = 0 with x = ξ², negative at 0 and 1
  // at 1.
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    const double value = ((x - 8) * x + (24 - 16 * eta)) * x - 16 * (1 - eta);
    (value < 0 ? low : high) = x;
  }
  return shear_speed * std::sqrt(0.5 * (low + high));
}

double toughness_deflection(double fall, double effective_intensity, double toughness) {
  if (fall == 0 || !(effective_intensity > toughness)) return 0;
  const double widest =
      std::min(2 * std::acos(std::cbrt(toughness / effective_intensity)), std::acos(1.0 / 3));
  return fall / std::sqrt(1 + fall * fall) * widest;
}

double advance_length(double effective_intensity, double toughness, double resolution) {
  if (!(effective_intensity > 0) || effective_intensity < toughness) return 0;
  const double ratio = toughness / effective_intensity;
  return resolution * std::max(kLeastSpeedFraction, 1 - ratio * ratio);
}

}  // namespace conchoid
