#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "conchoid/core/union_find.hpp"
#include "conchoid/crack/closing/cell_grid.hpp"

namespace conchoid {

/// Disjoint sets of the cells inside, numbered in the order of their first cells.
struct CellSets {
  std::vector<std::int32_t> of_cell;  ///< by the cell's place among those inside
  std::int32_t count = 0;
};

/// The sets of cells that hang together by neighbours.
/// @param together  (place of a cell, axis, place of the next one) → whether these two do
template <class Together>
CellSets sets_of_cells(const CellGrid& grid, const Together& together) {
  const std::vector<InsideCell>& inside = grid.inside_cells();
  CellSets sets;
  // Of cells one after the other along the third axis, at first.
  std::vector<std::int32_t>& run = sets.of_cell;
  run.resize(inside.size());
  std::int32_t runs = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const bool goes_on =
        i > 0 && inside[i - 1].next[2] == static_cast<std::int32_t>(i) && together(i - 1, 2, i);
    run[i] = goes_on ? runs - 1 : runs++;
  }
  UnionFind joined(static_cast<std::size_t>(runs));
  for (int axis = 0; axis < 2; ++axis) {
    std::pair<std::int32_t, std::int32_t> last{-1, -1};
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (inside[i].next[axis] < 0) continue;
      const auto n = static_cast<std::size_t>(inside[i].next[axis]);
      const std::pair pair{run[i], run[n]};
      if (pair == last || !together(i, axis, n)) continue;
      joined.join(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
      last = pair;
    }
  }
  std::vector<std::int32_t> set(static_cast<std::size_t>(runs));
  for (std::size_t r = 0; r < set.size(); ++r) {
    const std::size_t first = joined.root(r);
    set[r] = first == r ? sets.count++ : set[first];
  }
  for (std::int32_t& of : sets.of_cell)
    of = set[static_cast<std::size_t>(of)];
  return sets;
}

}  // namespace conchoid
