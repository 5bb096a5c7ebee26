#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A mesh as the set of its triangles' coordinates, each turned so that the smallest corner comes first:
/// equal for meshes that differ only in numbering. Orientation counts.
using TriangleSoup = std::multiset<std::array<std::array<double, 3>, 3>>;
inline TriangleSoup triangle_soup(const TriMesh& mesh) {
  TriangleSoup soup;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = mesh.positions[mesh.corners[TriId(t)][k]];
      corners[k] = {x.x() + 0.0, x.y() + 0.0, x.z() + 0.0};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    soup.insert(corners);
  }
  return soup;
}

/// Triangles of the size 0.2 anywhere in the cube from −1 to 1, through each other.
inline TriMesh random_soup(std::size_t triangles, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TriMesh m;
  for (std::size_t t = 0; t < triangles; ++t) {
    const Vec3 center(uniform(random), uniform(random), uniform(random));
    std::array<NodeId, 3> corners;
    for (NodeId& c : corners)
      c = m.positions.add(center + 0.2 * Vec3(uniform(random), uniform(random), uniform(random)));
    m.corners.add(corners);
  }
  return m;
}

/// Reverses the orientation of all triangles.
inline TriMesh flipped(TriMesh mesh) {
  for (auto& c : mesh.corners)
    std::swap(c[1], c[2]);
  return mesh;
}

/// Mirror image across the plane x_axis = 0, oriented so that a body stays a body.
inline TriMesh mirrored(TriMesh mesh, int axis) {
  for (Vec3& x : mesh.positions)
    x[axis] = -x[axis];
  return flipped(std::move(mesh));
}

inline double smallest_angle_degrees(const Triangle& x) {
  double smallest = 180;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
    smallest = std::min(smallest, std::atan2(cross(a, b).norm(), a.dot(b)) * 180 / std::numbers::pi);
  }
  return smallest;
}

inline double smallest_angle_degrees(const TriMesh& mesh) {
  double smallest = 180;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    smallest = std::min(smallest, smallest_angle_degrees(mesh.triangle(TriId(t))));
  return smallest;
}

/// Adds the triangles of another mesh, moved.
inline void append(TriMesh& mesh, const TriMesh& other, const Vec3& shift = Vec3::Zero()) {
  const TriMesh added = other;  // which may be the mesh itself
  const auto first = static_cast<std::int32_t>(mesh.node_count());
  for (const Vec3& x : added.positions)
    mesh.positions.push_back(x + shift);
  for (const auto& c : added.corners)
    mesh.corners.push_back(
        {NodeId(c[0].value + first), NodeId(c[1].value + first), NodeId(c[2].value + first)});
}

}  // namespace conchoid
