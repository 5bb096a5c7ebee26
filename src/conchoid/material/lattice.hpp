#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "conchoid/core/random.hpp"
#include "conchoid/core/vec.hpp"

namespace conchoid {

using Cell = std::array<std::int64_t, 3>;

/// The cell of the unit lattice that x lies in.
inline Cell cell_of(const Vec3& x) {
  return {static_cast<std::int64_t>(std::floor(x[0])), static_cast<std::int64_t>(std::floor(x[1])),
          static_cast<std::int64_t>(std::floor(x[2]))};
}

/// Random bits of a cell, the same whenever it is asked.
inline std::uint64_t cell_bits(std::uint64_t mixed_seed, const Cell& c) {
  std::uint64_t h = mixed_seed;
  for (std::int64_t i : c)
    h = mix_bits(h ^ static_cast<std::uint64_t>(i));
  return h;
}

/// Three numbers in [0, 1) from 63 bits.
inline Vec3 unit_numbers(std::uint64_t bits) {
  const auto part = [&](int k) { return static_cast<double>((bits >> (21 * k)) & 0x1fffff) * 0x1p-21; };
  return {part(0), part(1), part(2)};
}

}  // namespace conchoid
