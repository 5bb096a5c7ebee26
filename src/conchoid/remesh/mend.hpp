#pragma once

#include <cstddef>
#include <string>

#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/remesh/weld.hpp"

namespace conchoid {

/// What mending has changed, means by means, in the order in which they are tried.
struct MendReport {
  WeldReport weld;                ///< loose seams and needles closed
  std::size_t dropped = 0;        ///< triangles that use a node twice, or have the nodes of another
  std::size_t flipped = 0;        ///< triangles without area turned over, no point moved
  std::size_t filled_holes = 0;   ///< closed without new nodes
  std::size_t inner_walls = 0;    ///< triangles of walls inside and of fins outside, dropped
  std::size_t split_nodes = 0;    ///< added where parts only touched
  std::size_t flat_parts = 0;     ///< parts without volume, dropped
  std::size_t united_bodies = 0;  ///< that became part of another
  std::size_t cut_triangles = 0;  ///< triangles around intersections, replaced by new ones

  /// "2 flat triangles flipped, 1 hole closed": what is not zero; empty if all is.
  std::string text() const;
};

/// The surface mended where it is bad and left alone elsewhere: no lattice, no new shape. Each means is tried
/// only if there is something for it to do. Whether that was enough, find_defects tells.
/// @param mesh  finite, indices in range
TriMesh mended(const TriMesh& mesh, MendReport& report);

}  // namespace conchoid
