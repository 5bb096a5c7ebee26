#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Sorts what lies on edges by them, in linear time: few lie on edges with the same lower node. Stable.
/// @param edge_of  the edge of an item; its nodes are below node_count
template <class T, class EdgeOf>
void sort_by_edge(std::vector<T>& items, std::size_t node_count, const EdgeOf& edge_of) {
  std::vector<std::size_t> begin(node_count + 1, 0);  // of the items of each lower node
  for (const T& item : items)
    ++begin[edge_of(item).a.index() + 1];
  for (std::size_t n = 0; n < node_count; ++n)
    begin[n + 1] += begin[n];
  const std::vector<T> unsorted = items;
  std::vector<std::size_t> next = begin;
  for (const T& item : unsorted)
    items[next[edge_of(item).a.index()]++] = item;
  for (std::size_t n = 0; n < node_count; ++n)
    for (std::size_t i = begin[n] + 1; i < begin[n + 1]; ++i)  // by insertion
      for (std::size_t k = i; k > begin[n] && edge_of(items[k]).b < edge_of(items[k - 1]).b; --k)
        std::swap(items[k], items[k - 1]);
}

/// How many triangles have an edge.
struct EdgeUse {
  Edge edge;
  int count;
};

/// Of every edge of the triangles, ascending.
std::vector<EdgeUse> edge_uses(const IdVector<TriId, std::array<NodeId, 3>>& triangles,
                               std::size_t node_count);

}  // namespace conchoid
