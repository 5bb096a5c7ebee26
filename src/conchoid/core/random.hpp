#pragma once

#include <cstdint>
#include <random>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Mixes bits (splitmix64): neighbouring numbers give unrelated results.
std::uint64_t mix_bits(std::uint64_t x);

/// Seeded random numbers that are the same on every machine: the engine is fixed by the C++ standard, the
/// distributions are written here because the standard leaves theirs open.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(mix_bits(seed)) {}
  /// Independent stream number `stream` of a seed, e.g. one per run of a database: the numbers of a run do
  /// not depend on which other runs were made.
  Random(std::uint64_t seed, std::uint64_t stream) : engine_(mix_bits(mix_bits(seed) ^ stream)) {}

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, …, n−1}, without bias. @param n  > 0
  std::uint64_t index(std::uint64_t n);
  /// Standard normal (polar method of Marsaglia).
  double normal();
  /// Uniform on the unit sphere.
  Vec3 unit_vector();

 private:
  std::mt19937_64 engine_;
};

}  // namespace conchoid
