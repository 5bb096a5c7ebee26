#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "conchoid/io/picture.hpp"

namespace conchoid {

/// What a ray meets.
struct SurfacePoint {
  std::size_t mesh = 0;
  TriId triangle;
  Vec3 barycentric;     ///< weights of the three corners
  double distance = 0;  ///< along the ray
};

/// The meshes of one panel, moved to the origin and scaled to unit radius, ready for rays (Embree, single
/// precision).
class RayScene {
 public:
  /// @param center, radius  [m]: what becomes the origin and the unit of length
  RayScene(const std::vector<PictureMesh>& meshes, const Vec3& center, double radius);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// First triangle along origin + s·direction, s > start. `opaque_only` leaves ghosts out.
  std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction, double start, double end,
                                        bool opaque_only) const;
  bool blocked(const Vec3& origin, const Vec3& direction) const;

  /// Position of a mesh's node in the scene's units.
  Vec3 position(std::size_t mesh, NodeId node) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
  const std::vector<PictureMesh>& meshes_;
  Vec3 center_;
  double radius_;
};

}  // namespace conchoid
