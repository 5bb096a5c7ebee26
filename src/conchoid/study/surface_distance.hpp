#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// How far two surfaces lie apart [m].
struct SurfaceDistance {
  double mean = 0;
  double p95 = 0;  ///< 95th percentile
};

/// Distances from points spread evenly over `from` to the nearest point of `to`, weighted by the area each
/// point stands for. The points are fixed by the mesh alone: about `samples` of them, at least one in every
/// triangle.
SurfaceDistance one_sided_distance(const TriMesh& from, const TriMesh& to, std::size_t samples = 20000);

/// Mean of both directions. Two empty surfaces: 0. One empty: NaN.
SurfaceDistance symmetric_distance(const TriMesh& a, const TriMesh& b, std::size_t samples = 20000);

}  // namespace conchoid
