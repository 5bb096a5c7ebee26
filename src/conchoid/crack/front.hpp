#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

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
std::vector<Front> find_fronts(const TriMesh& crack, const std::vector<Edge>& mouth);

}  // namespace conchoid
