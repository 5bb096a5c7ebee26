#pragma once

#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// How long edges should be at a place, relative to open, flat parts (1): shorter where the body is thin, so
/// that limbs keep enough triangles around. The local half thickness is the radius of the largest ball inside
/// the body that touches the surface at a node (shrinking ball, Ma, Bae & Choi 2012); balls that touch again
/// less than 100° away are those of edges and of noise and do not count.
class SizeField {
 public:
  /// `edge`: the edge length that the value 1 stands for [m]. `samples`: a moderately fine mesh of the
  /// surface.
  SizeField(const TriMesh& samples, double edge);

  double operator()(const Vec3& x) const;
  /// Number of triangles that the whole surface takes if edges are `edge` times the field.
  double triangle_count(double edge) const;

 private:
  TriMesh samples_;
  ClosestPointTree surface_;
  IdVector<NodeId, double> size_;
};

}  // namespace conchoid
