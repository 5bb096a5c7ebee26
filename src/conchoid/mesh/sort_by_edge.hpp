#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "conchoid/core/parallel.hpp"
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
  constexpr std::size_t nodes_of_task = 4096;
  parallel_for(node_count, nodes_of_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = begin[first]; i < begin[last]; ++i) {  // by insertion
      const T item = items[i];
      const Edge edge = edge_of(item);
      std::size_t k = i;
      for (; k > begin[first]; --k) {
        const Edge before = edge_of(items[k - 1]);
        if (before.a != edge.a || !(edge.b < before.b)) break;
        items[k] = items[k - 1];
      }
      if (k < i) items[k] = item;
    }
  });
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
