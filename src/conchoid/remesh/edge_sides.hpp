#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A side of a triangle.
struct EdgeSide {
  Edge edge;
  TriId triangle;
  bool forward;  ///< the triangle runs through it from edge.a to edge.b
};

/// All sides by edge; those of one edge by triangle.
std::vector<EdgeSide> sides_by_edge(const TriMesh& mesh);

/// Calls visit(begin, end) for the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeSide>& sides, const Visit& visit) {
  for (auto begin = sides.begin(); begin != sides.end();) {
    auto end = begin + 1;
    while (end != sides.end() && end->edge == begin->edge)
      ++end;
    visit(begin, end);
    begin = end;
  }
}

/// The sides of one edge in the order in which a plane that turns about edge.a → edge.b, counter-clockwise seen
/// from edge.b, meets them.
std::vector<EdgeSide> around_edge(const TriMesh& mesh, std::vector<EdgeSide> sides);

}  // namespace conchoid
