#include "conchoid/io/ray_scene.hpp"

namespace conchoid {

RayScene::RayScene(const std::vector<PictureMesh>& meshes, const Vec3& center, double radius)
    : meshes_(meshes), center_(center), radius_(radius) {
  const auto make = module_function<MakeRayTracer>(kPictureModule, "conchoid_make_ray_tracer", "pictures");
  std::vector<RayMesh> for_rays;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriMesh& mesh = meshes[m].mesh;
    RayMesh& out = for_rays.emplace_back();
    out.opaque = meshes[m].opacity >= 1;
    for (std::size_t n = 0; n < mesh.node_count(); ++n) {
      const Vec3 x = position(m, NodeId(n));
      out.positions.push_back({static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])});
    }
    for (const auto& c : mesh.corners)
      out.corners.push_back({static_cast<unsigned>(c[0].value), static_cast<unsigned>(c[1].value),
                             static_cast<unsigned>(c[2].value)});
  }
  make(for_rays, tracer_);
}

Vec3 RayScene::position(std::size_t mesh, NodeId node) const {
  return (meshes_[mesh].mesh.positions[node] - center_ + meshes_[mesh].offset) / radius_;
}

}  // namespace conchoid
