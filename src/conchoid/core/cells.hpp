#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// A cell of a grid of cubes, by whole numbers: key of what lies near a place.
struct Cell {
  std::int64_t x, y, z;
  bool operator==(const Cell&) const = default;
};

/// The cell that x lies in, for cells of the given edge [m] from the origin of coordinates on.
inline Cell cell_of(const Vec3& x, double edge) {
  const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / edge)); };
  return {index(x[0]), index(x[1]), index(x[2])};
}

/// Calls visit(cell) for all cells from `low` to `high`, both included.
template <class Visit>
void for_each_cell(const Cell& low, const Cell& high, const Visit& visit) {
  for (std::int64_t i = low.x; i <= high.x; ++i)
    for (std::int64_t j = low.y; j <= high.y; ++j)
      for (std::int64_t k = low.z; k <= high.z; ++k)
        visit(Cell{i, j, k});
}

/// For unordered containers; neighbours spread over all buckets.
struct CellHash {
  std::size_t operator()(const Cell& c) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 32)) + static_cast<std::uint64_t>(c.y) * 0xC2B2AE3D27D4EB4Full;
    h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(c.z) * 0x165667B19E3779F9ull;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};

}  // namespace conchoid
