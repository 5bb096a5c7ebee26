#pragma once

#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

enum class BoundaryKind : unsigned char { traction, displacement };

/// Data on the surface: on each triangle either the traction t = σ·n [Pa] (constant) or the displacement
/// (linear, given at the nodes).
struct BoundaryData {
  std::vector<BoundaryKind> kind;  ///< per triangle
  std::vector<Vec3> traction;      ///< per triangle [Pa], read where kind is traction
  IdVector<NodeId, Vec3>
      displacement;  ///< per node [m], read at nodes of triangles whose kind is displacement

  bool pure_traction() const;
};

/// A traction-free surface of n triangles and m nodes, to be filled in.
BoundaryData free_surface(const TriMesh& surface);

/// A known stress field in equilibrium with body forces, superposed on what the elements compute: the stress
/// at infinity of an unbounded body, or the stress that belongs to the rigid acceleration of an unbalanced
/// one. Empty functions: none.
struct AmbientField {
  std::function<Mat3(const Vec3&)> stress;        ///< [Pa]
  std::function<Vec3(const Vec3&)> displacement;  ///< [m]
};

AmbientField uniform_stress(const Mat3& stress, double youngs_modulus, double poisson_ratio);

}  // namespace conchoid
