#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "conchoid/core/union_find.hpp"
#include "conchoid/crack/closing/cell_grid.hpp"

namespace conchoid {

/// Disjoint sets of the cells inside, numbered in the order of their first cells.
struct CellSets {
  std::vector<std::int32_t> of_cell;  ///< by the cell's number
  std::int32_t count = 0;
};

/// The sets of cells that hang together by neighbours.
/// @param together  (number of a cell, axis, number of the one ahead) → whether these two do
template <class Together>
CellSets sets_of_cells(const CellGrid& grid, const Together& together) {
  // Of cells one after the other along the third axis, at first.
  CellSets sets;
  std::vector<std::int32_t>& chain = sets.of_cell;
  chain.resize(grid.inside_count());
  std::vector<std::int32_t> end;  // of each chain
  for (const CellRun& run : grid.runs())
    for (std::int32_t i = run.number; i < run.end(); ++i) {
      if (i == run.number || !together(static_cast<std::size_t>(i) - 1, 2, static_cast<std::size_t>(i)))
        end.push_back(i);
      end.back() = i + 1;
      chain[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(end.size()) - 1;
    }
  UnionFind joined(end.size());
  for (int axis = 0; axis < 2; ++axis)
    for (const CellPairs& pairs : grid.pairs(axis))
      for (std::int32_t k = 0; k < pairs.count;) {
        const auto i = static_cast<std::size_t>(pairs.number + k),
                   n = static_cast<std::size_t>(pairs.ahead + k);
        if (!together(i, axis, n)) {
          ++k;
          continue;
        }
        const auto a = static_cast<std::size_t>(chain[i]), b = static_cast<std::size_t>(chain[n]);
        joined.join(a, b);
        k = std::min(end[a] - pairs.number, end[b] - pairs.ahead);  // no more is to be learned of these two
      }
  std::vector<std::int32_t> set(end.size());
  for (std::size_t c = 0; c < set.size(); ++c) {
    const std::size_t first = joined.root(c);
    set[c] = first == c ? sets.count++ : set[first];
  }
  for (std::int32_t& of : sets.of_cell)
    of = set[static_cast<std::size_t>(of)];
  return sets;
}

}  // namespace conchoid
