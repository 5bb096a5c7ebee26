#include "conchoid/mesh/tri_mesh.hpp"

#include <algorithm>

#include "conchoid/core/union_find.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {

Vec3 area_vector(const TriMesh& mesh, TriId t) {
  const auto& c = mesh.corners[t];
  return 0.5 * area_vector2(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]);
}

Vec3 unit_normal(const TriMesh& mesh, TriId t) {
  const Vec3 a = area_vector(mesh, t);
  const double length = a.norm();
  return length > 0 ? Vec3(a / length) : Vec3::Zero();
}

Vec3 centroid(const TriMesh& mesh, TriId t) {
  const auto& c = mesh.corners[t];
  return (mesh.positions[c[0]] + mesh.positions[c[1]] + mesh.positions[c[2]]) / 3.0;
}

double enclosed_volume(const TriMesh& mesh) {
  if (mesh.positions.empty()) return 0;
  const Vec3 origin = mesh.positions.front();  // near the body: no cancellation when it lies far from 0
  double six_volume = 0;
  for (const auto& c : mesh.corners)
    six_volume += (mesh.positions[c[0]] - origin)
                      .dot(cross(mesh.positions[c[1]] - origin, mesh.positions[c[2]] - origin));
  return six_volume / 6.0;
}

double surface_area(const TriMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    area += area_vector(mesh, TriId(t)).norm();
  return area;
}

Box bounding_box(const TriMesh& mesh) {
  if (mesh.positions.empty()) return {Vec3::Zero(), Vec3::Zero()};
  Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Vec3& x : mesh.positions) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

IdVector<TriId, std::array<TriId, 3>> triangle_neighbours(const TriMesh& mesh) {
  struct Side {
    Edge edge;
    TriId triangle;
    int corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& c = mesh.corners[TriId(t)];
      sides.push_back({Edge(c[k], c[(k + 1) % 3]), TriId(t), k});
    }
  sort_by_edge(sides, mesh.node_count(), [](const Side& s) { return s.edge; });
  IdVector<TriId, std::array<TriId, 3>> neighbours(mesh.triangle_count());
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    if (sides[i].edge == sides[i + 1].edge) {
      neighbours[sides[i].triangle][sides[i].corner] = sides[i + 1].triangle;
      neighbours[sides[i + 1].triangle][sides[i + 1].corner] = sides[i].triangle;
    }
  return neighbours;
}

std::vector<int> connected_parts(const TriMesh& mesh) {
  UnionFind parts(mesh.node_count());
  for (const auto& c : mesh.corners)
    for (std::size_t k = 1; k < 3; ++k)
      parts.join(c[0].index(), c[k].index());
  std::vector<int> part(mesh.node_count());
  int count = 0;
  for (std::size_t i = 0; i < part.size(); ++i)
    part[i] = parts.root(i) == i ? count++ : part[parts.root(i)];
  return part;
}

}  // namespace conchoid
