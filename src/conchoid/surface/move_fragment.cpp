#include "conchoid/surface/move_fragment.hpp"

namespace conchoid {
namespace {

// @param face  of the piece's mesh, per triangle of `mesh`
template <class FaceOf>
void move_mesh(TriMesh& mesh, const Fragment& fragment, const FaceOf& face, const Vec3& shift,
               const TriMesh& surface, const IdVector<NodeId, Vec3>& positions) {
  IdVector<NodeId, NodeId> own(mesh.node_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (fragment.face_kind[face(t)] != FaceKind::original) continue;
    for (const NodeId node : mesh.corners[TriId(t)])
      for (const NodeId of_surface : surface.corners[fragment.source[face(t)]])
        if (mesh.positions[node] == surface.positions[of_surface]) own[node] = of_surface;
  }
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    mesh.positions[NodeId(n)] =
        own[NodeId(n)].valid() ? positions[own[NodeId(n)]] : Vec3(mesh.positions[NodeId(n)] + shift);
}

}  // namespace

void move_fragment(Fragment& fragment, const Vec3& shift, const TriMesh& surface,
                   const IdVector<NodeId, Vec3>& positions) {
  UnfinishedCracks& cracks = fragment.unfinished;
  const auto of_mesh = [](std::size_t t) { return t; };
  const auto of_solid = [&](std::size_t t) { return cracks.solid_face[t].index(); };
  move_mesh(fragment.mesh, fragment, of_mesh, shift, surface, positions);
  move_mesh(cracks.solid, fragment, of_solid, shift, surface, positions);
  for (TriMesh& sheet : cracks.sheets)
    for (Vec3& x : sheet.positions)
      x += shift;
  fragment.center_of_mass += shift;
}

}  // namespace conchoid
