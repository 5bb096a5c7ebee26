#include "conchoid/mesh/place.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "conchoid/core/parallel.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/mesh/id_lists.hpp"

namespace conchoid {

namespace {

// Places that are equal have the same one; −0 is 0.
std::size_t hash_of(const Vec3& x) {
  std::size_t hash = 0;
  for (const double value : x)
    hash = mix_bits(hash ^ std::hash<double>{}(value));
  return hash;
}

}  // namespace

IdVector<NodeId, NodeId> first_at_place(const TriMesh& mesh) {
  constexpr std::size_t nodes_of_task = 4096;
  const std::size_t n = mesh.node_count();
  const std::vector<std::uint32_t> bucket = parallel_values(n, nodes_of_task, [&](std::size_t i) {
    return static_cast<std::uint32_t>(hash_of(mesh.positions[NodeId(i)]) % n);
  });
  const IdLists<NodeId, NodeId> nodes(n, [&](const auto& put) {  // of each bucket, ascending
    for (std::size_t i = 0; i < n; ++i)
      put(NodeId(std::size_t{bucket[i]}), NodeId(i));
  });
  IdVector<NodeId, NodeId> first(n);
  parallel_for(n, nodes_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Place here = place(mesh.positions[NodeId(i)]);
      const auto among = nodes[NodeId(std::size_t{bucket[i]})];
      first[NodeId(i)] = *std::find_if(among.begin(), among.end(), [&](NodeId m) {
        return m.index() == i || place(mesh.positions[m]) == here;
      });
    }
  });
  return first;
}

NodeId NodeWelder::operator()(const Vec3& x) {
  const auto [found, is_new] = nodes_.try_emplace(place(x), NodeId());
  if (is_new) found->second = mesh_.positions.add(x + Vec3::Zero());  // + 0: no negative zeros
  return found->second;
}

}  // namespace conchoid
