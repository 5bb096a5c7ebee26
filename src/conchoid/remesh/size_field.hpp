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

  /// The same with other values at the samples' nodes: they grow no faster than 0.4 of an edge per edge.
  SizeField(const SizeField& field, double edge, IdVector<NodeId, double> values);

  const TriMesh& samples() const { return samples_; }
  /// At the nodes of the samples.
  const IdVector<NodeId, double>& values() const { return size_; }
  double operator()(const Vec3& x) const;
  /// Number of triangles that the whole surface takes if edges are `edge` times the field.
  double triangle_count(double edge) const;

 private:
  void limit_growth(double edge);

  TriMesh samples_;
  ClosestPointTree surface_;
  IdVector<NodeId, double> size_;
};

}  // namespace conchoid
