#include "conchoid/material/grains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "conchoid/material/lattice.hpp"

namespace conchoid {

namespace {

// All in units of the grain size, in stretched coordinates.
constexpr double kMargin = 0.1;     ///< of a cell that holds no point
constexpr int kReach = 2;           ///< cells looked at on each side
constexpr double kRadius = 2.1;     ///< points farther away have no weight: kReach + kMargin
constexpr double kNegligible = 30;  ///< exponent: e⁻³⁰ of the nearest point's weight
constexpr double kLight = 1e-4;     ///< pairs of less weight do not count (their share is its cube)

struct Grain {
  Vec3 point, from_point;  // x − point
  double distance2;
  double factor;              // m
  double weight = 0;          // W
  Vec3 slope = Vec3::Zero();  // ∇ ln φ, then ∇W
};

double axis_distance(double t, int offset) {
  return offset > 0 ? offset - t : offset < 0 ? t - (offset + 1) : 0.0;
}

/// Grains with points close enough to matter: at most `spare` farther (squared) than the nearest.
std::vector<Grain> near_grains(const Vec3& y, std::uint64_t mixed_seed, double spread, double spare) {
  const Cell base = cell_of(y);
  const Vec3 t =
      y - Vec3(static_cast<double>(base[0]), static_cast<double>(base[1]), static_cast<double>(base[2]));
  std::vector<Grain> found;
  found.reserve(32);
  double nearest = kRadius * kRadius;
  const auto look_at = [&](int i, int j, int k) {
    const Vec3 gap(axis_distance(t[0], i), axis_distance(t[1], j), axis_distance(t[2], k));
    if (gap.squaredNorm() > std::min(nearest + spare, kRadius * kRadius)) return;
    const std::uint64_t bits = cell_bits(mixed_seed, {base[0] + i, base[1] + j, base[2] + k});
    Grain grain;
    grain.point = Vec3(i, j, k) + Vec3::Constant(kMargin) + (1 - 2 * kMargin) * unit_numbers(bits);
    grain.from_point = t - grain.point;
    grain.distance2 = grain.from_point.squaredNorm();
    if (grain.distance2 >= kRadius * kRadius) return;
    grain.factor = 1 + spread * (2 * unit_numbers(mix_bits(bits))[0] - 1);
    nearest = std::min(nearest, grain.distance2);
    found.push_back(grain);
  };
  for (int reach = 0; reach <= kReach; ++reach)  // from the inside out, so that much can be skipped
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k)
          if (std::max({std::abs(i), std::abs(j), std::abs(k)}) == reach) look_at(i, j, k);
  std::erase_if(found, [&](const Grain& g) { return g.distance2 > nearest + spare; });
  return found;
}

/// Weights and their gradients. @param softness  φ = exp(−r²/softness) · fading
void set_weights(std::vector<Grain>& grains, double softness) {
  double nearest = std::numeric_limits<double>::infinity(), sum = 0;
  for (const Grain& g : grains)
    nearest = std::min(nearest, g.distance2);
  for (Grain& g : grains) {
    const double left = 1 - g.distance2 / (kRadius * kRadius);
    g.weight = std::exp(-(g.distance2 - nearest) / softness) * left * left * left;
    g.slope = (-2 / softness - 6 / (kRadius * kRadius * left)) * g.from_point;
    sum += g.weight;
  }
  Vec3 mean = Vec3::Zero();
  for (Grain& g : grains) {
    g.weight /= sum;
    mean += g.weight * g.slope;
  }
  for (Grain& g : grains)
    g.slope = g.weight * (g.slope - mean);
}

/// B and its gradient.
FieldSample boundary(const std::vector<Grain>& grains, double width) {
  FieldSample b{0, Vec3::Zero()};
  const double scale = 2 / width;
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t j = i + 1; j < grains.size(); ++j) {
      const Grain &p = grains[i], &q = grains[j];
      if (p.weight + q.weight < kLight) continue;
      const Vec3 apart = p.point - q.point;
      const double distance = apart.norm();
      const double z = scale * (q.distance2 - p.distance2) / (2 * distance);
      if (z * z > kNegligible) continue;
      const double bump = std::exp(-z * z), both = p.weight + q.weight;
      b.value += bump * both * both * both;
      b.gradient += (-2 * z * bump * scale * both * both * both / distance) * apart +
                    (3 * bump * both * both) * (p.slope + q.slope);
    }
  return b;
}

}  // namespace

FieldSample Grains::at(const Vec3& x) const {
  const Vec3 unit = size * stretch;
  const Vec3 y = x.cwiseQuotient(unit);
  const double b = width / size;
  std::vector<Grain> grains = near_grains(y, mix_bits(seed), spread, kNegligible * b / 2);
  set_weights(grains, b / 2);
  double mean = 0;
  Vec3 slope = Vec3::Zero();
  for (const Grain& g : grains) {
    mean += g.weight * g.factor;
    slope += g.factor * g.slope;
  }
  const double rate = std::log(1 - weakening);
  if (rate == 0) return {mean, slope.cwiseQuotient(unit)};
  const FieldSample B = boundary(grains, b);
  const double weak = std::exp(rate * B.value);
  return {mean * weak, (weak * (slope + mean * rate * B.gradient)).cwiseQuotient(unit)};
}

}  // namespace conchoid
