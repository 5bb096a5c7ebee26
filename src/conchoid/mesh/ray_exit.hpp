#pragma once

#include "conchoid/mesh/box_tree.hpp"

namespace conchoid {

/// Distance along a ray to where it leaves a body through a triangle; +∞ if it does not. Rays through an edge leave
/// through both of its triangles.
/// @param direction     unit vector
/// @param least_cosine  between the ray and the normal of the triangle, ≥ 0: at a more grazing angle it does not count
double exit_distance(const Triangle& triangle, const Vec3& x, const Vec3& direction, double least_cosine = 0);

/// The nearest such distance > 0 among the triangles of a closed surface; +∞ if there is none.
double exit_distance(const TriMesh& surface, const BoxTree& tree, const Vec3& x, const Vec3& direction);

}  // namespace conchoid
