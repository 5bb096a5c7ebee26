#include "conchoid/io/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <limits>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

RTCRay make_ray(const Vec3& origin, const Vec3& direction, double start, double end) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin[0]);
  ray.org_y = static_cast<float>(origin[1]);
  ray.org_z = static_cast<float>(origin[2]);
  ray.dir_x = static_cast<float>(direction[0]);
  ray.dir_y = static_cast<float>(direction[1]);
  ray.dir_z = static_cast<float>(direction[2]);
  ray.tnear = static_cast<float>(start);
  ray.tfar = static_cast<float>(end);
  ray.mask = 0xFFFFFFFFu;
  return ray;
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene everything = nullptr, opaque = nullptr;

  ~Embree() {
    if (everything) rtcReleaseScene(everything);
    if (opaque) rtcReleaseScene(opaque);
    if (device) rtcReleaseDevice(device);
  }
};

RayScene::RayScene(const std::vector<PictureMesh>& meshes, const Vec3& center, double radius)
    : embree_(std::make_unique<Embree>()), meshes_(meshes), center_(center), radius_(radius) {
  // One builder thread: the same tree, and so the same picture, on every machine setting.
  embree_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!embree_->device)
    throw ComputationError("the ray tracer (Embree) could not be started; is the processor too old for it?");
  embree_->everything = rtcNewScene(embree_->device);
  embree_->opaque = rtcNewScene(embree_->device);
  for (RTCScene scene : {embree_->everything, embree_->opaque}) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriMesh& mesh = meshes[m].mesh;
    if (mesh.triangle_count() == 0) continue;
    RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.node_count()));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangle_count()));
    for (std::size_t n = 0; n < mesh.node_count(); ++n) {
      const Vec3 x = position(m, NodeId(n));
      for (int i = 0; i < 3; ++i)
        *vertices++ = static_cast<float>(x[i]);
    }
    for (const auto& triangle : mesh.corners)
      for (NodeId c : triangle)
        *corners++ = static_cast<unsigned>(c.value);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree_->everything, geometry, static_cast<unsigned>(m));
    if (meshes[m].opacity >= 1) rtcAttachGeometryByID(embree_->opaque, geometry, static_cast<unsigned>(m));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(embree_->everything);
  rtcCommitScene(embree_->opaque);
}

RayScene::~RayScene() = default;

std::optional<SurfacePoint> RayScene::first_hit(const Vec3& origin, const Vec3& direction, double start,
                                                double end, bool opaque_only) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, start, end);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(opaque_only ? embree_->opaque : embree_->everything, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const double u = query.hit.u, v = query.hit.v;
  return SurfacePoint{
      query.hit.geomID, TriId(static_cast<std::size_t>(query.hit.primID)), {1 - u - v, u, v}, query.ray.tfar};
}

bool RayScene::blocked(const Vec3& origin, const Vec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction, 0, std::numeric_limits<float>::infinity());
  rtcOccluded1(embree_->opaque, &context, &ray);
  return ray.tfar < 0;
}

Vec3 RayScene::position(std::size_t mesh, NodeId node) const {
  return (meshes_[mesh].mesh.positions[node] - center_ + meshes_[mesh].offset) / radius_;
}

}  // namespace conchoid
