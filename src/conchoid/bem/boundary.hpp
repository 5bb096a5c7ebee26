#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Which components of the displacement are prescribed on a triangle ("held"); of the others the traction is.
/// Kept as the orthogonal projection H onto the held directions:
///   traction H = 0 · displacement H = I · a roller that runs across n, or a plane of symmetry, H = n nᵀ
class BoundaryKind {
 public:
  static const BoundaryKind traction, displacement;

  constexpr BoundaryKind() = default;                                            ///< traction
  constexpr explicit BoundaryKind(const std::array<double, 6>& H) : held_(H) {}  ///< xx yy zz yz xz xy
  /// @param directions  orthonormal
  static BoundaryKind holding(std::span<const Vec3> directions);

  Mat3 held() const;
  bool holds_nothing() const { return *this == traction; }
  bool holds_all() const { return *this == displacement; }
  friend constexpr bool operator==(const BoundaryKind&, const BoundaryKind&) = default;

 private:
  std::array<double, 6> held_{};
};
inline constexpr BoundaryKind BoundaryKind::traction{};
inline constexpr BoundaryKind BoundaryKind::displacement{{1, 1, 1, 0, 0, 0}};

/// Projection onto the sum of the spaces that two orthogonal projections leave. Exact where one of them holds
/// the other, and for axes that both have. Directions less than 1e-6 rad apart count as one.
Mat3 join_held(const Mat3& a, const Mat3& b);

/// Data on the surface: on each triangle the traction t = σ·n [Pa] (constant) or the displacement (linear, given
/// at the nodes), component by component.
struct BoundaryData {
  std::vector<BoundaryKind> kind;       ///< per triangle
  std::vector<Vec3> traction;           ///< per triangle [Pa], read in directions that are not held
  IdVector<NodeId, Vec3> displacement;  ///< per node [m], read in directions held by a triangle around it
};

/// A traction-free surface of n triangles and m nodes, to be filled in.
BoundaryData free_surface(const TriMesh& surface);

/// A known stress field in equilibrium with body forces, superposed on what the elements compute: the stress
/// at infinity of an unbounded body, or the stress that belongs to weight, rotation and the acceleration of an unbalanced
/// one. Empty functions: none.
struct AmbientField {
  std::function<Mat3(const Vec3&)> stress;        ///< [Pa]
  std::function<Vec3(const Vec3&)> displacement;  ///< [m]
};

AmbientField uniform_stress(const Mat3& stress, double youngs_modulus, double poisson_ratio);

}  // namespace conchoid
