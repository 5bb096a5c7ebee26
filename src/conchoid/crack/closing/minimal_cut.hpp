#pragma once

#include <cstdint>
#include <vector>

#include "conchoid/crack/closing/cell_grid.hpp"

namespace conchoid {

/// A body's cells in two.
struct CellPartition {
  std::vector<std::int8_t> side;  ///< per cell inside of the body: 1 or −1
};

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
