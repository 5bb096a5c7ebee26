#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "conchoid/crack/closing/cell_grid.hpp"

namespace conchoid {

/// A body's cells in two.
struct CellPartition {
  std::vector<std::int8_t> side;  ///< per cell inside of the body: 1 or −1
};

/// Calls found(number, number ahead, cell, axis) for neighbours that nothing parts and of which one at least is in the band.
template <class Found>
void for_faces_in_band(const CellGrid& grid, const std::vector<std::uint8_t>& band, const Found& found) {
  const auto any = [&](std::int32_t first, std::int32_t count) {
    return std::memchr(band.data() + first, 1, static_cast<std::size_t>(count)) != nullptr;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const CellPairs& pairs : grid.pairs(axis)) {
      if (!any(pairs.number, pairs.count) && !any(pairs.ahead, pairs.count)) continue;
      for (std::int32_t k = 0; k < pairs.count; ++k) {
        const auto i = static_cast<std::size_t>(pairs.number + k),
                   n = static_cast<std::size_t>(pairs.ahead + k);
        if ((band[i] || band[n]) && grid.open(i, axis))
          found(i, n, pairs.cell + static_cast<std::size_t>(k), axis);
      }
    }
}

/// The division of the body with the least new surface that keeps the two sides of a crack apart: a minimal
/// cut of the graph of cells, in which a face between neighbours costs its area where nothing stands between
/// them and nothing where a crack does, and a face of the crack itself whose cell is on the wrong side costs
/// `kUnusedFace` of its own. All on one side where that is cheaper: as long as what is left to break is not
/// much smaller than the crack. New surface is made within the band only; cells beyond it that hang together
/// there stay together. Y. Boykov & V. Kolmogorov, An experimental comparison of min-cut/max-flow
/// algorithms (2004).
/// @param crack  per triangle of the grid's sheets: whether it belongs to the crack
/// @param band   per cell inside: whether it is in the band
/// @param known  per cell inside, beyond the band: its side, 1 or −1, where that is settled, else 0; empty: nowhere
CellPartition minimal_cut(const CellGrid& grid, const std::vector<bool>& crack,
                          const std::vector<std::uint8_t>& band, const std::vector<std::int8_t>& known = {});

}  // namespace conchoid
