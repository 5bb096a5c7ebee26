#include "conchoid/material/noise.hpp"

#include <cmath>

#include "conchoid/material/lattice.hpp"

namespace conchoid {

namespace {

/// Standard deviation of gradient noise whose lattice gradients are uniform in [−1, 1]³: 8 A² B with A = ∫u²,
/// B = ∫t²u² over [0, 1], u = 1 − 10t³ + 15t⁴ − 6t⁵.
constexpr double kDeviation = 0.190940;
/// Lattice edges per wavelength 2π σ/σ', measured (tests/material/field_test.cpp).
constexpr double kCellsPerWavelength = 2.41;

struct Blend {
  std::array<double, 2> weight, slope;  // of the lower and the upper corner
  explicit Blend(double t) {
    const double upper = t * t * t * (t * (6 * t - 15) + 10), rise = 30 * t * t * (t - 1) * (t - 1);
    weight = {1 - upper, upper};
    slope = {-rise, rise};
  }
};

/// Gradient noise on the unit lattice, not normalised, added to `value` and `gradient` with a factor.
void add_noise(std::uint64_t mixed_seed, const Vec3& x, double factor, double& value, Vec3& gradient) {
  const Cell base = cell_of(x);
  const Vec3 t =
      x - Vec3(static_cast<double>(base[0]), static_cast<double>(base[1]), static_cast<double>(base[2]));
  const Blend bx(t[0]), by(t[1]), bz(t[2]);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) {
        const Vec3 g =
            2 * unit_numbers(cell_bits(mixed_seed, {base[0] + i, base[1] + j, base[2] + k})) - Vec3::Ones();
        const double ramp = g.dot(t - Vec3(i, j, k));
        const double weight = bx.weight[i] * by.weight[j] * bz.weight[k];
        const Vec3 slope(bx.slope[i] * by.weight[j] * bz.weight[k], bx.weight[i] * by.slope[j] * bz.weight[k],
                         bx.weight[i] * by.weight[j] * bz.slope[k]);
        value += factor * weight * ramp;
        gradient += factor * (ramp * slope + weight * g);
      }
}

}  // namespace

FieldSample Noise::at(const Vec3& x) const {
  const double cells = kCellsPerWavelength / wavelength;
  double value = 0, power = 0, weight = 1, frequency = 1;
  Vec3 gradient = Vec3::Zero();
  for (int o = 0; o < octaves; ++o) {
    const std::uint64_t mixed_seed = mix_bits(mix_bits(seed) + static_cast<std::uint64_t>(o));
    const Vec3 offset = unit_numbers(mixed_seed);
    double octave = 0;
    Vec3 slope = Vec3::Zero();
    add_noise(mixed_seed, (frequency * cells) * x + offset, 1, octave, slope);
    value += weight * octave;
    gradient += (weight * frequency) * slope;
    power += weight * weight;
    weight *= gain;
    frequency *= 2;
  }
  const double scale = power > 0 ? amplitude / (kDeviation * std::sqrt(power)) : 0;
  const double f = std::exp(scale * value);
  return {f, (f * scale * cells) * gradient};
}

}  // namespace conchoid
