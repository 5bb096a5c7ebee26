#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A list for each node, all of them side by side in memory.
template <class Value>
class NodeLists {
 public:
  /// @param visit  calls what it is given with every node and value that belong together, the same both times;
  ///               the values of a node keep that order
  template <class Visit>
  NodeLists(std::size_t node_count, const Visit& visit) : end_(node_count + 1, 0) {
    visit([&](NodeId n, const Value&) { ++end_[n.index() + 1]; });
    for (std::size_t n = 0; n < node_count; ++n)
      end_[n + 1] += end_[n];
    values_.resize(end_.back());
    std::vector<std::size_t> next(end_.begin(), end_.end() - 1);
    visit([&](NodeId n, const Value& value) { values_[next[n.index()]++] = value; });
  }

  std::span<const Value> operator[](NodeId n) const {
    return std::span(values_).subspan(end_[n.index()], end_[n.index() + 1] - end_[n.index()]);
  }

 private:
  std::vector<std::size_t> end_;  ///< of the list of the node before
  std::vector<Value> values_;
};

/// Triangles around each node, ascending.
inline NodeLists<TriId> triangles_at_nodes(const TriMesh& mesh) {
  return NodeLists<TriId>(mesh.node_count(), [&](const auto& put) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      for (const NodeId n : mesh.corners[TriId(t)])
        put(n, TriId(t));
  });
}

}  // namespace conchoid
