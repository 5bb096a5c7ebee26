#pragma once

#include <array>
#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Unit normals for shading, one per triangle corner: the area-weighted mean over the triangles around the
/// corner's node that are of the same kind and whose normals differ by less than the crease angle, so that
/// edges of the body and rims of fractures stay sharp. A triangle without area takes the mean of all around.
/// @param face_kind     per triangle; empty: all of one kind
/// @param crease_angle  [rad]
std::vector<std::array<Vec3, 3>> corner_normals(const TriMesh& mesh, const std::vector<FaceKind>& face_kind,
                                                double crease_angle = 0.6);

/// One unit normal per node, for files that keep one per node and whose triangles share their nodes: the mean
/// of `corner_normal` over the corners at the node, weighted by triangle area. Only original faces count
/// where the node has one, so that the surface keeps its normals up to the rim of a break; fracture faces
/// elsewhere. A node whose corners that count all say the same takes it bit for bit; one whose mean vanishes
/// takes the corner of the largest triangle.
/// @param face_kind      per triangle; empty: all of one kind
/// @param corner_normal  per triangle corner: unit, or zero for a corner that does not count
IdVector<NodeId, Vec3> node_normals(const TriMesh& mesh, const std::vector<FaceKind>& face_kind,
                                    const std::vector<std::array<Vec3, 3>>& corner_normal);

}  // namespace conchoid
