#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Points of a cubic lattice and which of them are inside a surface.
struct InsideLattice {
  Vec3 origin = Vec3::Zero();  ///< point (0, 0, 0) [m]
  double voxel = 0;            ///< distance of neighbours [m]
  std::array<std::size_t, 3> size = {0, 0, 0};
  std::vector<std::uint8_t> inside;  ///< 1 inside, x runs fastest

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return i + size[0] * (j + size[1] * k);
  }
  Vec3 point(std::size_t index) const;
};

/// How many lattice points a surface with this box needs along each axis: two to spare on all sides.
std::array<std::size_t, 3> lattice_size(const Box& box, double voxel);

/// A point is inside where the surface winds around it at least once: overlapping bodies become one, cavities
/// stay. Counted exactly as crossings along the lines of the lattice in z, with rules for lines through edges
/// and nodes that always agree between neighbouring triangles.
/// @param surface  closed in the sense of boundary_loops; may be non-manifold and pass through itself
InsideLattice inside_lattice(const TriMesh& surface, double voxel);

/// The boundary of the inside points as a triangle mesh: every cube of the lattice in six tetrahedra about
/// its diagonal (1,1,1), every tetrahedron cut by one triangle or two. Closed, manifold, oriented outward and
/// free of self-intersections by construction: tetrahedra share their faces and every piece stays inside its
/// own. A node lies on the lattice edge where the distances to the surface from both ends would be in
/// balance, which on a flat part is on the surface, but at least 1/20 of the edge away from either end.
TriMesh lattice_boundary(const InsideLattice& lattice, const TriMesh& surface);

}  // namespace conchoid
