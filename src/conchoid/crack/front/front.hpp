#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Whose normal e1 of a front's frames is: that of the facets behind the front, as on a crack that has grown
/// — its last row lies in the direction it took — or, as on a mesh of a smooth curved crack, the same carried
/// on from the middle of the last row to the front by what it turns from row to row (a kink, more than 0.15 …
/// 0.3 rad, is not carried on).
enum class FrontNormals { facets, carried_on };

/// Right-handed frame of a front point: e1 crack normal, e2 forward out of the crack (in its plane), e3 = e1
/// × e2 tangent.
struct FrontFrame {
  Vec3 e1, e2, e3;
};

/// One connected crack front: nodes in order along e3, so that walking along the front with e1 up the crack
/// lies to the left or right consistently (e2 = e3 × e1 points away from the crack).
struct Front {
  std::vector<NodeId> nodes;
  bool closed = false;             ///< ring (crack inside the body) or open (ends at the surface)
  std::vector<FrontFrame> frames;  ///< per node
};

/// Fronts of a crack mesh: its boundary edges that are not mouth edges, joined into curves.
/// @param mouth  boundary edges on the body's surface (sorted), empty for a crack in the inside
std::vector<Front> find_fronts(const TriMesh& crack, const std::vector<Edge>& mouth,
                               FrontNormals kind = FrontNormals::facets);
/// The same with the area vectors around the nodes at hand, as those of the whole sheet that `crack` is part of.
std::vector<Front> find_fronts(const TriMesh& crack, const std::vector<Edge>& mouth, FrontNormals kind,
                               const IdVector<NodeId, Vec3>& normals);

}  // namespace conchoid
