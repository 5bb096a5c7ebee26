#include "conchoid/core/random.hpp"

#include <cmath>
#include <limits>

namespace conchoid {

std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t Random::index(std::uint64_t n) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t limit =
      kMost - kMost % n;  // a multiple of n: what lies above would favour small results
  std::uint64_t x = bits();
  while (x >= limit)
    x = bits();
  return x % n;
}

double Random::normal() {
  for (;;) {
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    const double s = x * x + y * y;
    if (s > 0 && s < 1) return x * std::sqrt(-2 * std::log(s) / s);
  }
}

Vec3 Random::unit_vector() {
  for (;;) {  // Marsaglia 1972
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    const double s = x * x + y * y;
    if (s >= 1) continue;
    const double root = 2 * std::sqrt(1 - s);
    return {x * root, y * root, 1 - 2 * s};
  }
}

}  // namespace conchoid
