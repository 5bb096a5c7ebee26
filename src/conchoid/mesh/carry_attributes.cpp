#include "conchoid/mesh/carry_attributes.hpp"

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {

SurfaceAttributes attributes_of(const SurfaceAttributes& all, const std::vector<TriId>& triangles) {
  SurfaceAttributes out;
  out.materials = all.materials;
  out.groups = all.groups;
  for (const TriId t : triangles) {
    if (!all.normal.empty()) out.normal.push_back(all.normal[t.index()]);
    if (!all.uv.empty()) out.uv.push_back(all.uv[t.index()]);
    if (!all.material.empty()) out.material.push_back(all.material[t.index()]);
    if (!all.group.empty()) out.group.push_back(all.group[t.index()]);
  }
  return out;
}

SurfaceAttributes carried_over(const AttributedMesh& from, const TriMesh& to) {
  if (from.attributes.empty()) return {};
  const ClosestPointTree tree(from.mesh);
  const auto source = parallel_values(
      to.triangle_count(), 256, [&](std::size_t t) { return tree.closest(centroid(to, TriId(t))).triangle; });
  SurfaceAttributes out = attributes_of(from.attributes, source);
  for (std::size_t t = 0; t < source.size(); ++t) {
    const Triangle there = from.mesh.triangle(source[t]), here = to.triangle(TriId(t));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 w = barycentric_weights(there, closest_point_on_triangle(there, here[k]));
      if (!out.normal.empty()) {
        Vec3 normal = Vec3::Zero();
        for (std::size_t j = 0; j < 3; ++j)
          normal += w[static_cast<Eigen::Index>(j)] * from.attributes.normal[source[t].index()][j];
        out.normal[t][k] = normal.norm() > 0 ? Vec3(normal.normalized()) : normal;
      }
      if (!out.uv.empty()) {
        Vec2 uv = Vec2::Zero();
        for (std::size_t j = 0; j < 3; ++j)
          uv += w[static_cast<Eigen::Index>(j)] * from.attributes.uv[source[t].index()][j];
        out.uv[t][k] = uv;
      }
    }
  }
  return out;
}

}  // namespace conchoid
