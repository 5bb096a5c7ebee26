#pragma once

#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/feature_lines.hpp"

namespace conchoid {

/// Collapses edges in the order of their quadric error (Garland & Heckbert 1997: sum of area-weighted squared
/// distances from the planes of the triangles merged so far) until `target_triangles` are left or no further
/// step is possible.
void decimate(EditableMesh& mesh, FeatureLines& features, std::size_t target_triangles);

}  // namespace conchoid
