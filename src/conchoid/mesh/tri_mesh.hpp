#pragma once

#include <array>
#include <string>
#include <vector>

#include "conchoid/core/ids.hpp"
#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Indexed triangle mesh. Corners are counter-clockwise seen from the side the normal points to (outside of a
/// body).
struct TriMesh {
  IdVector<NodeId, Vec3> positions;  ///< [m]
  IdVector<TriId, std::array<NodeId, 3>> corners;

  std::size_t node_count() const { return positions.size(); }
  std::size_t triangle_count() const { return corners.size(); }
  Triangle triangle(TriId t) const {
    const auto& c = corners[t];
    return {positions[c[0]], positions[c[1]], positions[c[2]]};
  }
};

/// Area vector (b−a)×(c−a)/2 of a triangle [m²]: unit normal times area.
Vec3 area_vector(const TriMesh& mesh, TriId t);
/// Unit normal; zero vector for a degenerate triangle.
Vec3 unit_normal(const TriMesh& mesh, TriId t);
Vec3 centroid(const TriMesh& mesh, TriId t);
/// Signed volume enclosed by a closed mesh [m³], positive when oriented outward.
double enclosed_volume(const TriMesh& mesh);
double surface_area(const TriMesh& mesh);

/// Axis-aligned box.
struct Box {
  Vec3 low, high;
  double diagonal() const { return (high - low).norm(); }
  Vec3 center() const { return 0.5 * (low + high); }
};
Box bounding_box(const TriMesh& mesh);

/// Undirected edge, smaller node id first.
struct Edge {
  NodeId a, b;
  Edge(NodeId p, NodeId q) : a(p < q ? p : q), b(p < q ? q : p) {}
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

/// For corner k of triangle t, neighbour[t][k] is the triangle across the edge (corner k, corner k+1), or
/// invalid at a boundary. The mesh must be edge-manifold (at most two triangles on an edge).
IdVector<TriId, std::array<TriId, 3>> triangle_neighbours(const TriMesh& mesh);

/// Connected part (0, 1, …) of each node, counted by the parts' smallest ids.
std::vector<int> connected_parts(const TriMesh& mesh);

}  // namespace conchoid
