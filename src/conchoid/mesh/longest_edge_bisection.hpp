#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A triangle that came from another one when that was divided in two.
struct HalfTriangle {
  std::array<NodeId, 3> corners;  ///< the middle of the edge that was divided last
  std::array<Vec3, 3>
      in_parent;      ///< the corner functions of the first mesh's triangle at these corners, exact
  std::size_t whole;  ///< the half that was divided, or kNoHalf: a triangle of the first mesh was
};
inline constexpr std::size_t kNoHalf = static_cast<std::size_t>(-1);

/// A mesh whose triangles have been divided, and which of the first one each came from.
struct DividedMesh {
  TriMesh mesh;  ///< the first one's nodes keep their ids and bits; pieces of a triangle follow one another
  std::vector<TriId> parent;
  std::vector<HalfTriangle>
      halves;  ///< all there ever were, those that were divided again before their own halves
  std::vector<std::size_t> half;  ///< per triangle: which half it is; kNoHalf where nothing was divided
};

/// Divides triangles at their longest edges until none is too coarse, and no more than conformity asks for (Rivara
/// 1984). Every node of the first mesh stays; new ones are middles of edges. No angle becomes smaller than half the
/// smallest one. Edges equally long to 1e-9 go by the ids of their nodes, so that a mesh that is turned or mirrored
/// is divided the same way, and a larger set of triangles that are too coarse only divides further.
DividedMesh bisect_longest_edges(const TriMesh& mesh, const std::function<bool(const Triangle&)>& too_coarse);

}  // namespace conchoid
