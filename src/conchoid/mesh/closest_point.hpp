#pragma once

#include <limits>
#include <vector>

#include "conchoid/mesh/box_tree.hpp"

namespace conchoid {

/// Point of a (closed) triangle nearest to x, in double precision.
Vec3 closest_point_on_triangle(const Triangle& triangle, const Vec3& x);

/// The triangle of a mesh that is nearest to x.
struct ClosestHit {
  TriId triangle;             ///< invalid for a mesh without triangles
  Vec3 point = Vec3::Zero();  ///< [m]
  double squared_distance =
      std::numeric_limits<double>::infinity();  ///< [m²], +∞ for a mesh without triangles
};

/// For a single place, for which no tree is made; of triangles that are equally near the one with the smallest id.
ClosestHit closest_point(const TriMesh& mesh, const Vec3& x);

/// Nearest point of a triangle mesh to any point: exact point-triangle distances, found through a tree of
/// boxes. Same input, same answer; of triangles that are equally near the one with the smallest id is
/// returned.
class ClosestPointTree {
 public:
  using Hit = ClosestHit;

  explicit ClosestPointTree(const TriMesh& mesh);
  Hit closest(const Vec3& x) const;

 private:
  std::vector<Triangle> triangles_;
  BoxTree tree_;
};

}  // namespace conchoid
