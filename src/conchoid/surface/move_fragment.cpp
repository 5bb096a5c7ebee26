#include "conchoid/surface/move_fragment.hpp"

namespace conchoid {

void move_fragment(Fragment& fragment, const Vec3& shift, const TriMesh& surface,
                   const IdVector<NodeId, Vec3>& positions) {
  TriMesh& mesh = fragment.mesh;
  IdVector<NodeId, NodeId> own(mesh.node_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (fragment.face_kind[t] != FaceKind::original) continue;
    for (const NodeId node : mesh.corners[TriId(t)])
      for (const NodeId of_surface : surface.corners[fragment.source[t]])
        if (mesh.positions[node] == surface.positions[of_surface]) own[node] = of_surface;
  }
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    mesh.positions[NodeId(n)] =
        own[NodeId(n)].valid() ? positions[own[NodeId(n)]] : Vec3(mesh.positions[NodeId(n)] + shift);
  fragment.center_of_mass += shift;
}

}  // namespace conchoid
