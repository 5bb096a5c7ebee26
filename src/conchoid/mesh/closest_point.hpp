#pragma once

#include <vector>

#include "conchoid/mesh/box_tree.hpp"

namespace conchoid {

/// Point of a (closed) triangle nearest to x, in double precision.
Vec3 closest_point_on_triangle(const Triangle& triangle, const Vec3& x);

/// Nearest point of a triangle mesh to any point: exact point-triangle distances, found through a tree of
/// boxes. Same input, same answer; of triangles that are equally near the one with the smallest id is
/// returned.
class ClosestPointTree {
 public:
  struct Hit {
    TriId triangle;               ///< invalid for a mesh without triangles
    Vec3 point = Vec3::Zero();    ///< [m]
    double squared_distance = 0;  ///< [m²], +∞ for a mesh without triangles
  };

  explicit ClosestPointTree(const TriMesh& mesh);
  Hit closest(const Vec3& x) const;

 private:
  std::vector<Triangle> triangles_;
  BoxTree tree_;
};

}  // namespace conchoid
