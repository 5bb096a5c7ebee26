#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/core/module.hpp"
#include "conchoid/core/vec.hpp"
#include "conchoid/io/image.hpp"

namespace conchoid {

constexpr Module kPictureModule{"conchoid_pictures", "Embree", "CONCHOID_WITH_PICTURES"};

/// What a ray meets.
struct SurfacePoint {
  std::size_t mesh = 0;
  TriId triangle;
  Vec3 barycentric;     ///< weights of the three corners
  double distance = 0;  ///< along the ray
};

/// A mesh for rays.
struct RayMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<unsigned, 3>> corners;
  bool opaque;
};

/// Rays against meshes, in their units.
class RayTracer {
 public:
  virtual ~RayTracer() = default;
  /// First triangle along origin + s·direction, s > start. `opaque_only` leaves ghosts out.
  virtual std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction, double start,
                                                double end, bool opaque_only) const = 0;
  virtual bool blocked(const Vec3& origin, const Vec3& direction) const = 0;
};

using MakeRayTracer = void(const std::vector<RayMesh>& meshes, std::unique_ptr<const RayTracer>& tracer);

/// The bytes of a PNG file. Throws ComputationError with the reason.
using EncodePng = void(const Image& image, std::string& bytes);

}  // namespace conchoid
