#include "conchoid/surface/slit_faces.hpp"

#include <algorithm>
#include <array>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/mesh/place.hpp"

namespace conchoid {

SharedPlaces::SharedPlaces(const TriMesh& mesh) : first(first_at_place(mesh)), shared(mesh.node_count(), 0) {
  for (std::size_t n = 0; n < first.size(); ++n)
    if (first[NodeId(n)] != NodeId(n)) shared[NodeId(n)] = shared[first[NodeId(n)]] = 1;
}

std::vector<std::vector<std::size_t>> opposite_faces(const Fragment& f, const SharedPlaces& places) {
  constexpr std::size_t faces_of_task = 4096;
  const auto places_of = [&](std::size_t t) {
    std::array<NodeId, 3> key = f.mesh.corners[TriId(t)];
    for (NodeId& n : key)
      n = places.first[n];
    std::sort(key.begin(), key.end());
    return key;
  };
  const auto is_cut = [&](std::size_t t) { return f.face_kind[t] == FaceKind::fracture; };
  const NodeLists<std::size_t> at_first(f.mesh.node_count(), [&](const auto& put) {
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (is_cut(t)) put(places_of(t)[0], t);
  });
  return parallel_values(f.mesh.triangle_count(), faces_of_task, [&](std::size_t t) {
    std::vector<std::size_t> opposite;
    if (!is_cut(t)) return opposite;
    const auto key = places_of(t);
    for (const std::size_t other : at_first[key[0]])
      if (other != t && places_of(other) == key) opposite.push_back(other);
    return opposite;
  });
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
