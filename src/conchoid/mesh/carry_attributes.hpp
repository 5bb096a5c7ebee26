#pragma once

#include <vector>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

/// Attributes of some triangles of a mesh, in their order.
SurfaceAttributes attributes_of(const SurfaceAttributes& all, const std::vector<TriId>& triangles);

/// Attributes of a mesh for another one near it: a triangle takes the material of the triangle that its centre
/// is nearest to, and at each corner the values of that triangle at its point nearest to the corner (so that
/// both sides of a seam or crease keep their own).
SurfaceAttributes carried_over(const AttributedMesh& from, const TriMesh& to);

}  // namespace conchoid
