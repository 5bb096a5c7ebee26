#pragma once

#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {

/// The surface with triangles over every boundary loop, so that each edge is run through as often one way as
/// the other. Loops of up to 150 nodes get the triangulation of least area (Barequet & Sharir 1995; no new
/// nodes), longer ones a fan about their centre. The patches may pass through each other and through the
/// surface: the result bounds a volume, but need not be a good mesh.
TriMesh holes_filled(const TriMesh& mesh, const std::vector<BoundaryLoop>& loops);

}  // namespace conchoid
