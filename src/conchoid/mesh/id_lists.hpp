#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A list for each id below a number, all of them side by side in memory.
template <class Id, class Value>
class IdLists {
 public:
  /// @param visit  calls what it is given with every id and value that belong together, the same both times;
  ///               the values of an id keep that order
  template <class Visit>
  IdLists(std::size_t ids, const Visit& visit) : end_(ids + 1, 0) {
    visit([&](Id id, const Value&) { ++end_[id.index() + 1]; });
    for (std::size_t i = 0; i < ids; ++i)
      end_[i + 1] += end_[i];
    values_.resize(end_.back());
    std::vector<std::size_t> next(end_.begin(), end_.end() - 1);
    visit([&](Id id, const Value& value) { values_[next[id.index()]++] = value; });
  }

  std::size_t size() const { return end_.size() - 1; }
  std::span<const Value> operator[](Id id) const {
    return std::span(values_).subspan(end_[id.index()], end_[id.index() + 1] - end_[id.index()]);
  }

 private:
  std::vector<std::size_t> end_;  ///< of the list of the id before
  std::vector<Value> values_;
};

template <class Value>
using NodeLists = IdLists<NodeId, Value>;

/// Triangles around each node, ascending.
inline NodeLists<TriId> triangles_at_nodes(const IdVector<TriId, Corners>& triangles,
                                           std::size_t node_count) {
  return NodeLists<TriId>(node_count, [&](const auto& put) {
    for (TriId t(0); t.index() < triangles.size(); ++t.value)
      for (const NodeId n : triangles[t])
        put(n, t);
  });
}
inline NodeLists<TriId> triangles_at_nodes(const TriMesh& mesh) {
  return triangles_at_nodes(mesh.corners, mesh.node_count());
}

}  // namespace conchoid
