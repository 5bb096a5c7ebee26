#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Smallest convex solid that holds all nodes of a mesh (Qhull): closed, triangles only, oriented outward;
/// its nodes are nodes of the mesh, bit for bit and in their order. No node lies farther outside than 1e-12
/// of the mesh's size. Empty if the nodes lie in a plane, up to round-off.
TriMesh convex_hull(const TriMesh& mesh);

}  // namespace conchoid
