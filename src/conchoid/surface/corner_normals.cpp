#include "conchoid/surface/corner_normals.hpp"

#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/id_lists.hpp"

namespace conchoid {
namespace {

/// Mean of unit vectors weighted by area.
class MeanNormal {
 public:
  void add(const Vec3& normal, double area) {
    if (normal.isZero(0)) return;
    all_equal_ = empty() || (all_equal_ && normal == largest_);
    if (empty() || area > largest_area_) {
      largest_ = normal;
      largest_area_ = area;
    }
    sum_ += area * normal;
    total_ += area;
  }
  bool empty() const { return largest_.isZero(0); }
  Vec3 value() const {
    if (empty()) return Vec3::UnitZ();
    const double length = sum_.norm();
    return all_equal_ || !(length > kVanishing * total_) ? largest_ : Vec3(sum_ / length);
  }

 private:
  static constexpr double kVanishing = 1e-6;  ///< of the sum of areas: opposite faces, up to round-off
  Vec3 sum_ = Vec3::Zero(), largest_ = Vec3::Zero();
  double total_ = 0, largest_area_ = 0;
  bool all_equal_ = true;
};

}  // namespace

std::vector<std::array<Vec3, 3>> corner_normals(const TriMesh& mesh, const std::vector<FaceKind>& face_kind,
                                                double crease_angle) {
  constexpr std::size_t triangles_of_task = 2048;
  const NodeLists<TriId> around = triangles_at_nodes(mesh);
  std::vector<Vec3> area(mesh.triangle_count()), normal(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    area[t] = area_vector(mesh, TriId(t));
    normal[t] = unit_normal(mesh, TriId(t));
  }
  const auto same_kind = [&](std::size_t p, std::size_t q) {
    return face_kind.empty() || face_kind[p] == face_kind[q];
  };
  const double crease = std::cos(crease_angle);
  std::vector<std::array<Vec3, 3>> normals(mesh.triangle_count());
  const auto at_corner = [&](std::size_t t, NodeId n) {
    Vec3 sum = Vec3::Zero();
    for (const TriId other : around[n])
      if (same_kind(t, other.index()) &&
          (normal[t].isZero(0) || normal[t].dot(normal[other.index()]) >= crease))
        sum += area[other.index()];
    const double length = sum.norm();
    return length > 0 ? Vec3(sum / length) : normal[t].squaredNorm() > 0 ? normal[t] : Vec3::UnitZ();
  };
  parallel_for(mesh.triangle_count(), triangles_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        normals[t][k] = at_corner(t, mesh.corners[TriId(t)][k]);
  });
  return normals;
}

IdVector<NodeId, Vec3> node_normals(const TriMesh& mesh, const std::vector<FaceKind>& face_kind,
                                    const std::vector<std::array<Vec3, 3>>& corner_normal) {
  const auto is_fracture = [&](std::size_t t) {
    return !face_kind.empty() && face_kind[t] == FaceKind::fracture;
  };
  IdVector<NodeId, MeanNormal> mean(mesh.node_count());
  for (const bool fracture : {false, true}) {
    IdVector<NodeId, MeanNormal> found(mesh.node_count());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (is_fracture(t) != fracture) continue;
      const double area = area_vector(mesh, TriId(t)).norm();
      for (std::size_t k = 0; k < 3; ++k)
        found[mesh.corners[TriId(t)][k]].add(corner_normal[t][k], area);
    }
    for (std::size_t n = 0; n < mesh.node_count(); ++n)
      if (mean[NodeId(n)].empty()) mean[NodeId(n)] = found[NodeId(n)];
  }
  IdVector<NodeId, Vec3> normals(mesh.node_count());
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    normals[NodeId(n)] = mean[NodeId(n)].value();
  return normals;
}

}  // namespace conchoid
