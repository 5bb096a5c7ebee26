#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

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
  struct Branch {
    Box box;
    std::size_t begin = 0, end = 0;   ///< range of order_ below this branch
    std::size_t left = 0, right = 0;  ///< children; 0 for a leaf (the root is nobody's child)
  };

  std::size_t build(std::size_t begin, std::size_t end);

  std::vector<Triangle> triangles_;
  std::vector<std::size_t> order_;
  std::vector<Branch> branches_;
};

}  // namespace conchoid
