#pragma once

#include <vector>

#include "conchoid/crack/front/front.hpp"

namespace conchoid {

/// Sum of the area vectors of the triangles around each node [m²]: its direction is the area-weighted node
/// normal.
IdVector<NodeId, Vec3> node_area_vectors(const TriMesh& mesh);

/// The same as unit vectors; zero where all triangles are degenerate or there are none.
IdVector<NodeId, Vec3> unit_node_normals(const TriMesh& mesh);

/// Frames along a front. e1: node normal, of which kind see FrontNormals; e3: tangent of the circle through
/// the node and its two neighbours, at corners the bisector of the two edges, at an open end the one edge,
/// made perpendicular to e1; e2 = e3 × e1. A node whose triangles are all degenerate takes the frame of the
/// nearest node of the front that has one.
std::vector<FrontFrame> front_frames(const TriMesh& mesh, const IdVector<NodeId, Vec3>& normals,
                                     const std::vector<NodeId>& nodes, bool closed,
                                     FrontNormals kind = FrontNormals::facets);

/// (1−s) a + s b, made orthonormal again: e1 first, then e3 (e2 = e3 × e1). 0 ≤ s ≤ 1.
FrontFrame interpolate(const FrontFrame& a, const FrontFrame& b, double s);

/// cosθ e2 + sinθ e1: unit direction at angle θ.
Vec3 direction_at(const Vec3& e1, const Vec3& e2, double angle);

/// Turns a ring so that it starts at its smallest id: the same for every walk around it.
void start_at_smallest_id(std::vector<NodeId>& ring);

/// Neighbours of position i along a front of n nodes: i itself at an open end.
inline std::size_t previous_index(std::size_t i, std::size_t n, bool closed) {
  return i > 0 ? i - 1 : (closed ? n - 1 : i);
}
inline std::size_t next_index(std::size_t i, std::size_t n, bool closed) {
  return i + 1 < n ? i + 1 : (closed ? 0 : i);
}
/// Number of edges of a front of n nodes: edge i joins node i with the next one.
inline std::size_t edge_count(std::size_t n, bool closed) {
  return closed ? n : (n > 0 ? n - 1 : 0);
}

/// Components of v along e1, e2, e3.
inline Vec3 in_frame(const FrontFrame& frame, const Vec3& v) {
  return {v.dot(frame.e1), v.dot(frame.e2), v.dot(frame.e3)};
}
/// Its inverse: the vector whose components they are.
inline Vec3 in_world(const FrontFrame& frame, const Vec3& components) {
  return components[0] * frame.e1 + components[1] * frame.e2 + components[2] * frame.e3;
}

}  // namespace conchoid
