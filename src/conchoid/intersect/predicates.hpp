#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A point of the surface or of the sheet with the infinitesimal displacement that keeps the two in general
/// position:
///
///     x(ε) = x + ε^p·along + ε^16·across + ε^64·hash(id),   p = 1 for the sheet, 4 for the surface
///
/// `along`: the sheet moves along its own normal, the surface shrinks against its normals, which opens cracks
/// in it — a sheet in the plane of surface nodes passes beside them, a sheet that ends exactly on the surface
/// reaches through it. `across`: sum of the incident edge vectors with weights drawn from the ids, for lines
/// that would still meet. All but the last term (which is almost never reached) move with the meshes under
/// rotation, reflection and scaling.
struct PerturbedPoint {
  Vec3 x = Vec3::Zero();
  Vec3 along = Vec3::Zero();
  Vec3 across = Vec3::Zero();
  int exponent = 1;
  std::uint32_t id = 0;
};

/// The corners of one.
using PerturbedTriangle = std::array<const PerturbedPoint*, 3>;

enum class Role { surface, sheet };

/// Some nodes of a mesh with their displacements.
class PerturbedPoints {
 public:
  /// @param first_id  ids count from it (different for both meshes)
  /// @param nodes     which; they may be named again
  PerturbedPoints(const TriMesh& mesh, Role role, std::uint32_t first_id, const std::vector<NodeId>& nodes);

  /// Of one of these.
  const PerturbedPoint& operator[](NodeId n) const { return points_[static_cast<std::size_t>(number_[n])]; }
  /// All corners have to be among these.
  PerturbedTriangle triangle(const Corners& c) const {
    return {&(*this)[c[0]], &(*this)[c[1]], &(*this)[c[2]]};
  }

 private:
  IdVector<NodeId, std::int32_t> number_;  ///< among the points; −1: none
  std::vector<PerturbedPoint> points_;
};

/// Sign of (b−a)×(c−a)·(d−a) for ε → 0: +1 if d lies on the side of triangle abc from which it is seen
/// counter-clockwise. Exact; never 0 for points of different ids.
int orientation(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                const PerturbedPoint& d);

/// Whether p → q, which crosses the plane of the triangle, does so inside of it. Exact.
bool pierces(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& triangle);

/// Where the segment p → q crosses the plane of the triangle.
struct Crossing {
  double to_p, to_q;  ///< distances to p and q as shares of |pq|, ≥ 0, sum 1; accurate relative to themselves
  Vec3 point(const PerturbedPoint& p, const PerturbedPoint& q) const;
};
/// Requires p and q on different sides of the triangle's plane (`orientation` differs).
Crossing crossing(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& triangle);

/// Whether p → q crosses the plane of `first` before the plane of `second` for ε → 0. Exact. Both must be
/// crossed.
bool crosses_before(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& first,
                    const PerturbedTriangle& second);

}  // namespace conchoid
