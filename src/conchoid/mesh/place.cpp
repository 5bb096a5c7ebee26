#include "conchoid/mesh/place.hpp"

#include <algorithm>
#include <vector>

namespace conchoid {

IdVector<NodeId, NodeId> first_at_place(const TriMesh& mesh) {
  std::vector<NodeId> order(mesh.node_count());
  for (std::size_t n = 0; n < order.size(); ++n)
    order[n] = NodeId(n);
  std::sort(order.begin(), order.end(), [&](NodeId m, NodeId n) {
    const Place a = place(mesh.positions[m]), b = place(mesh.positions[n]);
    return a != b ? a < b : m < n;
  });
  IdVector<NodeId, NodeId> first(mesh.node_count());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && place(mesh.positions[order[i]]) == place(mesh.positions[order[i - 1]]);
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }
  return first;
}

NodeId NodeWelder::operator()(const Vec3& x) {
  const auto [found, is_new] = nodes_.try_emplace(place(x), NodeId());
  if (is_new) found->second = mesh_.positions.add(x + Vec3::Zero());  // + 0: no negative zeros
  return found->second;
}

}  // namespace conchoid
