#pragma once

#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A mesh whose triangles have been divided, and which of the first one each came from.
struct DividedMesh {
  TriMesh mesh;  ///< the first one's nodes keep their ids and bits; pieces of a triangle follow one another
  std::vector<TriId> parent;
};

/// Divides triangles at their longest edges until none is too coarse, and no more than conformity asks for (Rivara
/// 1984). Every node of the first mesh stays; new ones are middles of edges. No angle becomes smaller than half the
/// smallest one. Edges equally long to 1e-9 go by the ids of their nodes, so that a mesh that is turned or mirrored
/// is divided the same way, and a larger set of triangles that are too coarse only divides further.
DividedMesh bisect_longest_edges(const TriMesh& mesh, const std::function<bool(const Triangle&)>& too_coarse);

}  // namespace conchoid
