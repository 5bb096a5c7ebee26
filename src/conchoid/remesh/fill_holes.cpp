#include "conchoid/remesh/fill_holes.hpp"

#include "conchoid/mesh/polygon_triangles.hpp"

namespace conchoid {
namespace {

void fill_with_triangles(TriMesh& mesh, const BoundaryLoop& loop) {
  for (const auto& [i, j, k] : least_area_triangles(mesh.positions, loop))
    mesh.corners.push_back({loop[k], loop[j], loop[i]});
}

void fill_with_fan(TriMesh& mesh, const BoundaryLoop& loop) {
  Vec3 middle = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &p = mesh.positions[loop[i]], &q = mesh.positions[loop[(i + 1) % loop.size()]];
    middle += (q - p).norm() * (p + q) / 2;
    length += (q - p).norm();
  }
  const NodeId centre = mesh.positions.add(middle / length);
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.corners.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
}

}  // namespace

TriMesh holes_filled(const TriMesh& mesh, const std::vector<BoundaryLoop>& loops) {
  TriMesh out = mesh;
  for (const BoundaryLoop& loop : loops) {
    if (loop.size() < 3) continue;  // there and back again: nothing to fill
    loop.size() <= longest_for_least_area ? fill_with_triangles(out, loop) : fill_with_fan(out, loop);
  }
  return out;
}

}  // namespace conchoid
