#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// The triangles of a sheet, in their order, that keep it an oriented manifold with boundary along edges: one
/// that would be the third on an edge, or run along it in the direction another already does, is left out.
/// Nodes keep their ids. A fold that a growing crack front has laid over itself loses its upper layer that
/// way; a proper sheet comes back unchanged.
TriMesh manifold_part(const TriMesh& sheet);

/// Its manifold part without the triangles that pass through one with a lower id which is itself kept: what
/// grew first stays, what ran into it later is cut open there. Decided exactly. Degenerate triangles are left
/// out too.
TriMesh embedded_part(const TriMesh& sheet);

}  // namespace conchoid
