#pragma once

#include <string>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

enum class DefectKind {
  index_out_of_range,  ///< a corner names a node that does not exist
  not_finite,          ///< a node has a coordinate that is not finite
  repeated_node,       ///< a triangle uses a node twice
  degenerate,          ///< a triangle has no area: its height is below 1e-10 of its longest edge
  duplicate,           ///< two triangles have the same three nodes
  open_edge,           ///< an edge with one triangle (a hole)
  crowded_edge,        ///< an edge with three or more triangles
  inconsistent_edge,  ///< two neighbours run through their common edge in the same direction (one is flipped)
  pinched_node,       ///< a node whose triangles do not form one fan
  unused_node,        ///< a node without triangles
  inside_out,         ///< a component is oriented inward (or a cavity outward)
  no_volume,          ///< a closed component encloses no volume
  self_intersection,  ///< two triangles meet elsewhere than in common nodes and edges
  empty               ///< there are no triangles
};

inline constexpr std::size_t default_most_of_a_kind = 100;

/// One thing that is wrong with a mesh.
struct MeshDefect {
  DefectKind kind;
  std::string what;    ///< what is wrong and where, with 0-based element ids: "triangles 4 and 17 intersect"
  std::string remedy;  ///< what the user can do
  std::vector<TriId> triangles;
  std::vector<NodeId> nodes;
};

/// Everything that keeps a mesh from being the surface of a body: finite, closed, edge- and node-manifold,
/// oriented outward (cavities inward), every component with a volume, no degenerate, duplicate or
/// intersecting triangles. At most `most_of_a_kind` of each kind; geometric checks are left out while the
/// connectivity is broken. Intersections are decided exactly.
std::vector<MeshDefect> find_defects(const TriMesh& mesh,
                                     std::size_t most_of_a_kind = default_most_of_a_kind);

/// Likewise for an open crack sheet: finite, manifold, consistently oriented, no degenerate, duplicate or
/// intersecting triangles; boundary edges are allowed.
std::vector<MeshDefect> find_sheet_defects(const TriMesh& sheet);

/// Throws InputError "NAME: …" that lists the first defects with their remedies.
void require_valid_body(const TriMesh& mesh, const std::string& name);
void require_valid_sheet(const TriMesh& sheet, const std::string& name);

}  // namespace conchoid
