#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// What tidying a surface has changed.
struct TidyReport {
  std::size_t merged_nodes = 0;       ///< nodes with the same coordinates as another
  std::size_t removed_triangles = 0;  ///< without area, or with the same nodes as another
  std::size_t turned_triangles = 0;   ///< oriented anew
  std::size_t removed_nodes = 0;      ///< without triangles
};

/// The surface without the defects that can be mended where they are, no point moved: nodes of equal
/// coordinates become one, triangles without area or with the nodes of another are dropped, neighbours are
/// oriented alike (as the larger part of their area is), bodies outward, cavities inward, unused nodes are
/// dropped. What is left to do — holes, crowded edges, intersections — find_defects tells.
TriMesh tidied(const TriMesh& mesh, TidyReport& report);

/// Nodes of equal coordinates become the one of lowest id; returns how many did. Ids stay.
std::size_t merge_equal_nodes(TriMesh& mesh);
/// Drops triangles that use a node twice, and all but the first of those with the same nodes; without area,
/// too, if asked for. Returns how many.
std::size_t drop_useless_triangles(TriMesh& mesh, bool flat_ones = true);
/// Drops nodes without triangles and numbers the others anew in their order. Returns how many.
std::size_t drop_unused_nodes(TriMesh& mesh);
/// Turns over parts that are inside-out: bodies inward, cavities outward. Returns how many triangles.
std::size_t turn_parts(TriMesh& mesh);

/// Orients neighbours across edges of two triangles alike, as the larger part of the area of each patch that
/// such edges hold together is. Ids stay.
void orient_neighbours_alike(TriMesh& mesh);

}  // namespace conchoid
