#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "conchoid/core/parallel.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/crack/closing/cell_grid.hpp"

namespace conchoid {

/// Disjoint sets of the cells inside, numbered in the order of their first cells.
struct CellSets {
  /// Cells of one set that follow each other in a line, by number: first, …, end − 1.
  struct Chain {
    std::int32_t first = 0, end = 0, set = 0;
    std::int32_t size() const { return end - first; }
  };
  std::vector<Chain> chains;
  std::vector<std::int32_t> of_cell;  ///< by the cell's number
  std::int32_t count = 0;
};

/// The sets of cells that hang together by neighbours.
/// @param together  (number of a cell, axis, number of the one ahead) → whether these two do
template <class Together>
CellSets sets_of_cells(const CellGrid& grid, const Together& together) {
  CellSets sets;
  std::vector<CellSets::Chain>& chains = sets.chains;
  std::vector<std::int32_t>& of_cell = sets.of_cell;  // the chain, at first
  of_cell.resize(grid.inside_count());
  // Calls number(i) for each chain and keeps what it says with the chain's cells.
  const auto say = [&](const auto& number) {
    parallel_for(chains.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        std::fill(of_cell.begin() + chains[i].first, of_cell.begin() + chains[i].end, number(i));
    });
  };
  constexpr std::size_t at_once = 1024;
  const std::vector<CellRun>& runs = grid.runs();
  std::vector<std::vector<CellSets::Chain>> found((runs.size() + at_once - 1) / at_once);
  parallel_for(runs.size(), at_once, [&](std::size_t begin, std::size_t last) {
    for (std::size_t r = begin; r < last; ++r)
      for (std::int32_t first = runs[r].number, end = first; first < runs[r].end(); first = end) {
        ++end;
        while (end < runs[r].end() &&
               together(static_cast<std::size_t>(end) - 1, 2, static_cast<std::size_t>(end)))
          ++end;
        found[begin / at_once].push_back({first, end});
      }
  });
  for (const std::vector<CellSets::Chain>& more : found)
    chains.insert(chains.end(), more.begin(), more.end());
  say([](std::size_t i) { return static_cast<std::int32_t>(i); });
  UnionFind joined(chains.size());
  for (int axis = 0; axis < 2; ++axis)
    for (const CellPairs& pairs : grid.pairs(axis))
      for (std::int32_t k = 0; k < pairs.count;) {
        const auto i = static_cast<std::size_t>(pairs.number + k),
                   n = static_cast<std::size_t>(pairs.ahead + k);
        if (!together(i, axis, n)) {
          ++k;
          continue;
        }
        const auto a = static_cast<std::size_t>(of_cell[i]), b = static_cast<std::size_t>(of_cell[n]);
        joined.join(a, b);
        k = std::min(chains[a].end - pairs.number, chains[b].end - pairs.ahead);  // these two are done with
      }
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const std::size_t first = joined.root(c);
    chains[c].set = first == c ? sets.count++ : chains[first].set;
  }
  say([&](std::size_t i) { return chains[i].set; });
  return sets;
}

}  // namespace conchoid
