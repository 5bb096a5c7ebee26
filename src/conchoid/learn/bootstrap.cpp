#include <random>

#include "conchoid/learn/bagging.hpp"

namespace conchoid {

std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  // splitmix64 over the three numbers (Steele, Lea & Flood 2014)
  std::uint64_t state = 0;
  for (const std::uint64_t part : {seed, a, b}) {
    state += part + 0x9e3779b97f4a7c15u;
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
    state ^= state >> 31;
  }
  return state;
}

std::vector<std::uint32_t> bootstrap_counts(std::size_t n, std::uint64_t seed) {
  std::vector<std::uint32_t> counts(n, 0);
  if (n == 0) return counts;
  std::mt19937_64 random(seed);
  const std::uint64_t fair = n * (UINT64_MAX / n);  // numbers below are equally distributed modulo n
  for (std::size_t draw = 0; draw < n; ++draw) {
    std::uint64_t number = random();
    while (number >= fair)
      number = random();
    ++counts[number % n];
  }
  return counts;
}

}  // namespace conchoid
