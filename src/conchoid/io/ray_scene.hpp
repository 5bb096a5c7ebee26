#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "conchoid/io/picture.hpp"
#include "conchoid/io/picture_module.hpp"

namespace conchoid {

/// The meshes of one panel, moved to the origin and scaled to unit radius, ready for rays (Embree, single
/// precision).
class RayScene {
 public:
  /// @param center, radius  [m]: what becomes the origin and the unit of length
  RayScene(const std::vector<PictureMesh>& meshes, const Vec3& center, double radius);

  /// First triangle along origin + s·direction, s > start. `opaque_only` leaves ghosts out.
  std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction, double start, double end,
                                        bool opaque_only) const {
    return tracer_->first_hit(origin, direction, start, end, opaque_only);
  }
  bool blocked(const Vec3& origin, const Vec3& direction) const {
    return tracer_->blocked(origin, direction);
  }

  /// Position of a mesh's node in the scene's units.
  Vec3 position(std::size_t mesh, NodeId node) const;

 private:
  const std::vector<PictureMesh>& meshes_;
  Vec3 center_;
  double radius_;
  std::unique_ptr<const RayTracer> tracer_;
};

}  // namespace conchoid
