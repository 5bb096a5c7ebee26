#pragma once

#include <cstddef>
#include <string>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

/// Nodes closer than this share of the edges there (of both nodes: the longest one) are taken for one.
inline constexpr double weld_share = 1e-4;

struct WeldReport {
  std::size_t nodes = 0;      ///< that became another one
  std::size_t triangles = 0;  ///< dropped, because two of their nodes became one
  double farthest = 0;        ///< largest distance of a node from the one it became [m]
  bool bounds_body = false;   ///< what came out was looked at, and has no defects (welded_if_it_helps)

  /// "8 nodes were welded to others at most 2e-7 away, …"
  std::string text() const;
};

/// The surface with loose seams closed: nodes within `share` become the one of lowest id if they are joined by
/// an edge, or if both lie at an edge without exactly two triangles. So thin gaps and slits between closed
/// parts stay. Ids of the other nodes stay; nodes that nobody uses any more, too.
/// @param kept  per triangle of the result: its id before
TriMesh welded(const TriMesh& mesh, WeldReport& report, std::vector<TriId>* kept = nullptr,
               double share = weld_share);

/// A surface as a scene takes it from a file: as it is if it bounds a body; welded, without the nodes that are
/// left over, if that alone makes it bound one, which the caller should say; as it is, bad, otherwise.
/// @param report  no nodes unless it was welded
AttributedMesh welded_if_it_helps(AttributedMesh surface, WeldReport& report);

}  // namespace conchoid
