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

}  // namespace conchoid
