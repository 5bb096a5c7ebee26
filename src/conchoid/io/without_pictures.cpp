// In place of ray_scene.cpp and png.cpp where CONCHOID_WITH_PICTURES is off.
#include "conchoid/core/build_options.hpp"
#include "conchoid/io/image.hpp"
#include "conchoid/io/ray_scene.hpp"

namespace conchoid {
namespace {

[[noreturn]] void refuse() {
  throw_built_without("pictures", "Embree", "CONCHOID_WITH_PICTURES");
}

}  // namespace

struct RayScene::Embree {};

RayScene::RayScene(const std::vector<PictureMesh>& meshes, const Vec3&, double) : meshes_(meshes) {
  refuse();
}

RayScene::~RayScene() = default;

std::optional<SurfacePoint> RayScene::first_hit(const Vec3&, const Vec3&, double, double, bool) const {
  refuse();
}

bool RayScene::blocked(const Vec3&, const Vec3&) const {
  refuse();
}

Vec3 RayScene::position(std::size_t, NodeId) const {
  refuse();
}

void write_png(const std::filesystem::path&, const Image&) {
  refuse();
}

}  // namespace conchoid
