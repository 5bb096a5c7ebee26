#include "conchoid/surface/corner_normals.hpp"

#include <cmath>

namespace conchoid {

std::vector<std::array<Vec3, 3>> corner_normals(const TriMesh& mesh, const std::vector<FaceKind>& face_kind,
                                                double crease_angle) {
  IdVector<NodeId, std::vector<TriId>> around(mesh.node_count());
  std::vector<Vec3> area(mesh.triangle_count()), normal(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    area[t] = area_vector(mesh, TriId(t));
    normal[t] = unit_normal(mesh, TriId(t));
    for (NodeId c : mesh.corners[TriId(t)])
      around[c].push_back(TriId(t));
  }
  const auto same_kind = [&](std::size_t p, std::size_t q) {
    return face_kind.empty() || face_kind[p] == face_kind[q];
  };
  const double crease = std::cos(crease_angle);
  std::vector<std::array<Vec3, 3>> normals(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = Vec3::Zero();
      for (TriId other : around[mesh.corners[TriId(t)][k]])
        if (same_kind(t, other.index()) &&
            (normal[t].isZero(0) || normal[t].dot(normal[other.index()]) >= crease))
          sum += area[other.index()];
      const double length = sum.norm();
      normals[t][k] = length > 0                    ? Vec3(sum / length)
                      : normal[t].squaredNorm() > 0 ? normal[t]
                                                    : Vec3::UnitZ();
    }
  return normals;
}

}  // namespace conchoid
