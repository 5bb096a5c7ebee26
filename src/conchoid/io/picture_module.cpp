// Rays by Embree and PNG files: a module (core/module.hpp).
#include "conchoid/io/picture_module.hpp"

#include <embree3/rtcore.h>
#include <png.h>

#include <algorithm>
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

class EmbreeTracer : public RayTracer {
 public:
  explicit EmbreeTracer(const std::vector<RayMesh>& meshes) {
    // One builder thread: the same tree, and so the same picture, on every machine setting.
    device_ = rtcNewDevice("threads=1,set_affinity=0");
    if (!device_)
      throw ComputationError(
          "the ray tracer (Embree) could not be started; is the processor too old for it?");
    everything_ = rtcNewScene(device_);
    opaque_ = rtcNewScene(device_);
    for (RTCScene scene : {everything_, opaque_}) {
      rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
      rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    }
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (!meshes[m].corners.empty()) add(meshes[m], static_cast<unsigned>(m));
    rtcCommitScene(everything_);
    rtcCommitScene(opaque_);
  }

  ~EmbreeTracer() override {
    if (everything_) rtcReleaseScene(everything_);
    if (opaque_) rtcReleaseScene(opaque_);
    if (device_) rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction, double start, double end,
                                        bool opaque_only) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, start, end);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(opaque_only ? opaque_ : everything_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const double u = query.hit.u, v = query.hit.v;
    return SurfacePoint{query.hit.geomID,
                        TriId(static_cast<std::size_t>(query.hit.primID)),
                        {1 - u - v, u, v},
                        query.ray.tfar};
  }

  bool blocked(const Vec3& origin, const Vec3& direction) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = make_ray(origin, direction, 0, std::numeric_limits<float>::infinity());
    rtcOccluded1(opaque_, &context, &ray);
    return ray.tfar < 0;
  }

 private:
  void add(const RayMesh& mesh, unsigned id) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.corners.size()));
    for (const auto& x : mesh.positions)
      vertices = std::copy(x.begin(), x.end(), vertices);
    for (const auto& c : mesh.corners)
      corners = std::copy(c.begin(), c.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(everything_, geometry, id);
    if (mesh.opaque) rtcAttachGeometryByID(opaque_, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  RTCDevice device_ = nullptr;
  RTCScene everything_ = nullptr, opaque_ = nullptr;
};

}  // namespace
}  // namespace conchoid

CONCHOID_MODULE_FUNCTION void conchoid_make_ray_tracer(const std::vector<conchoid::RayMesh>& meshes,
                                                       std::unique_ptr<const conchoid::RayTracer>& tracer) {
  static_assert(std::is_same_v<decltype(conchoid_make_ray_tracer), conchoid::MakeRayTracer>);
  tracer = std::make_unique<const conchoid::EmbreeTracer>(meshes);
}

CONCHOID_MODULE_FUNCTION void conchoid_encode_png(const conchoid::Image& image, std::string& bytes) {
  static_assert(std::is_same_v<decltype(conchoid_encode_png), conchoid::EncodePng>);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  const auto encode = [&](void* memory, png_alloc_size_t& size) {
    if (!png_image_write_to_memory(&header, memory, &size, 0, image.rgb.data(), 0, nullptr))
      throw conchoid::ComputationError(header.message);
  };
  png_alloc_size_t size = 0;
  encode(nullptr, size);
  bytes.assign(size, '\0');
  encode(bytes.data(), size);
}
