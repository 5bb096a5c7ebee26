#include "conchoid/surface/slit_faces.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "conchoid/mesh/place.hpp"

namespace conchoid {

SharedPlaces::SharedPlaces(const TriMesh& mesh) : first(first_at_place(mesh)), shared(mesh.node_count(), 0) {
  for (std::size_t n = 0; n < first.size(); ++n)
    if (first[NodeId(n)] != NodeId(n)) shared[NodeId(n)] = shared[first[NodeId(n)]] = 1;
}

std::vector<std::vector<std::size_t>> opposite_faces(const Fragment& f, const SharedPlaces& places) {
  std::vector<std::pair<std::array<NodeId, 3>, std::size_t>> at;
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    if (f.face_kind[t] != FaceKind::fracture) continue;
    std::array<NodeId, 3> key = f.mesh.corners[TriId(t)];
    for (NodeId& n : key)
      n = places.first[n];
    std::sort(key.begin(), key.end());
    at.emplace_back(key, t);
  }
  std::sort(at.begin(), at.end());
  std::vector<std::vector<std::size_t>> opposite(f.mesh.triangle_count());
  for (std::size_t begin = 0, end = 0; begin < at.size(); begin = end) {
    while (end < at.size() && at[end].first == at[begin].first)
      ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = begin; k < end; ++k)
        if (k != i) opposite[at[i].second].push_back(at[k].second);
  }
  return opposite;
}

void keep_solid(Fragment& f) {
  const SharedPlaces places(f.mesh);
  const auto opposite = opposite_faces(f, places);
  IdVector<NodeId, char> of_slit(f.mesh.node_count(), 0);
  bool any = false;
  for (std::size_t t = 0; t < opposite.size(); ++t)
    if (!opposite[t].empty())
      for (const NodeId n : f.mesh.corners[TriId(t)])
        of_slit[n] = any = true;
  f.unfinished.solid = {};
  f.unfinished.solid_face.clear();
  if (!any) return;
  IdVector<NodeId, NodeId> moved(f.mesh.node_count());
  for (std::size_t t = 0; t < opposite.size(); ++t) {
    if (!opposite[t].empty()) continue;
    std::array<NodeId, 3> corners = f.mesh.corners[TriId(t)];
    for (NodeId& n : corners) {
      const NodeId from = of_slit[n] ? places.first[n] : n;
      if (!moved[from].valid()) moved[from] = f.unfinished.solid.positions.add(f.mesh.positions[from]);
      n = moved[from];
    }
    f.unfinished.solid.corners.push_back(corners);
    f.unfinished.solid_face.emplace_back(t);
  }
}

}  // namespace conchoid
