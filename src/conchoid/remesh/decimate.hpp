#pragma once

#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/feature_lines.hpp"

namespace conchoid {

/// Collapses edges in the order of their quadric error (Garland & Heckbert 1997: sum of area-weighted squared
/// distances from the planes of the triangles merged so far) until `target_triangles` are left or no further
/// step is possible.
void decimate(EditableMesh& mesh, FeatureLines& features, std::size_t target_triangles);

/// Likewise without a target, for a surface made anew close to `shape`: errors are measured from the planes of
/// the triangles of `shape` that are nearest, so that edges which the new surface has cut off come back where
/// these planes meet. Goes on while the root mean square of the distances merged into a node stays below
/// `tolerance` [m] and no edge at it becomes longer than `longest_edge` [m].
void simplify(EditableMesh& mesh, const TriMesh& shape, double tolerance, double longest_edge);

}  // namespace conchoid
