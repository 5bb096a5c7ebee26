#pragma once

#include <vector>

#include "conchoid/mesh/box.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A connected part of a surface, not necessarily a good one.
struct SurfacePart {
  std::vector<TriId> triangles;  ///< ascending
  bool closed = false;           ///< every edge is run through as often in one direction as in the other
  double volume = 0;             ///< signed, about the middle of its box where it is not closed [m³]
  double area = 0;               ///< [m²]
  int depth = 0;                 ///< in how many other parts it lies as a whole; these may have holes
  bool cavity() const { return depth % 2 == 1; }
  /// Oriented against what its depth asks for: outward at even depth, inward (a cavity) at odd depth.
  bool inside_out() const { return (volume > 0) == cavity(); }
};

/// The parts of a surface in the order of their first triangles.
std::vector<SurfacePart> surface_parts(const TriMesh& mesh);

/// The connected parts as meshes of their own: nodes and triangles in the order of the surface.
std::vector<TriMesh> split_parts(const TriMesh& mesh);

/// Some triangles as a mesh of their own; nodes in the order in which they come up.
TriMesh submesh(const TriMesh& mesh, const std::vector<TriId>& triangles);

/// The triangles whose boxes meet a box (touching counts), as a mesh of their own, in their order.
TriMesh part_within(const Box& box, const TriMesh& mesh);

/// Meshes as one, side by side: nodes and triangles in their order.
TriMesh join(const std::vector<TriMesh>& meshes);

/// The surface with a node of its own for each fan of triangles that meet in one node only: parts of a sheet that touch
/// at a point have boundaries that run past it, not through it. Copies are drawn by `gap` [m] towards the middle of their
/// fan; the first fan keeps the node's id. Edges have at most two triangles.
TriMesh split_fans(const TriMesh& mesh, double gap);

/// A closed chain of nodes along the boundary of a surface, in the direction that the triangles run through
/// its edges. The first node is not repeated at the end.
using BoundaryLoop = std::vector<NodeId>;

/// What the triangles leave over when every edge that is run through in both directions cancels: the
/// boundary of the surface in simple loops, in the order of their smallest nodes. Empty for a closed surface;
/// for triangles that are oriented differently an edge comes twice. The surface together with triangulations
/// of the reversed loops is closed, however bad it is.
std::vector<BoundaryLoop> boundary_loops(const TriMesh& mesh);

}  // namespace conchoid
