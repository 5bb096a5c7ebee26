#pragma once

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

using PlaneIndex = int;
using PlaneLink = std::pair<PlaneIndex, PlaneIndex>;  ///< nodes of an edge, ascending
using PlanePolygon =
    std::vector<PlaneIndex>;  ///< closed walk, counter-clockwise; nodes come twice along a slit

inline PlaneLink plane_link(PlaneIndex a, PlaneIndex b) {
  return a < b ? PlaneLink(a, b) : PlaneLink(b, a);
}

/// (b−a) × (c−a): twice the area, positive if counter-clockwise.
inline double plane_area2(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

/// Nodes of a triangle that is being divided, and the edges it has so far.
struct PlaneNodes {
  std::vector<Vec2> at;
  std::vector<int> edges_of;  ///< bit k: the node lies on edge k of the triangle
  std::set<PlaneLink> used;   ///< edges that must not come a second time as a diagonal

  /// No edge of a piece may join two nodes of one edge of the triangle, or double an edge that exists.
  bool allowed(PlaneIndex a, PlaneIndex b) const {
    return a != b && (edges_of[a] & edges_of[b]) == 0 && !used.contains(plane_link(a, b));
  }
};

/// Whether x is seen from corner i of the walk on its inner side (the left).
bool in_wedge(const PlaneNodes& nodes, const PlanePolygon& p, std::size_t i, const Vec2& x);

/// Divides a polygon (a walk, perhaps along slits and bridges) into triangles of best shape with no new
/// nodes; any coordinates give a valid combinatorial result. Appends the triangles and notes their edges as
/// used.
/// @throws ComputationError if the edges in use leave no triangulation
void triangulate_polygon(PlaneNodes& nodes, PlanePolygon polygon,
                         std::vector<std::array<PlaneIndex, 3>>& out);

}  // namespace conchoid
