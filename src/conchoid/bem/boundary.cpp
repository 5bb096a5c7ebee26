#include "conchoid/bem/boundary.hpp"

#include <cmath>

namespace conchoid {

BoundaryKind BoundaryKind::holding(std::span<const Vec3> directions) {
  if (directions.size() >= 3) return displacement;
  Mat3 H = Mat3::Zero();
  for (const Vec3& d : directions)
    H += d * d.transpose();
  return BoundaryKind({H(0, 0), H(1, 1), H(2, 2), H(1, 2), H(0, 2), H(0, 1)});
}

Mat3 BoundaryKind::held() const {
  Mat3 H;
  H << held_[0], held_[5], held_[4], held_[5], held_[1], held_[3], held_[4], held_[3], held_[2];
  return H;
}

Mat3 join_held(const Mat3& a, const Mat3& b) {
  constexpr double same_direction = 1e-6;
  if (a == b || b.isZero(0) || a.isIdentity(0)) return a;
  if (a.isZero(0) || b.isIdentity(0)) return b;
  Mat3 H = a;
  for (int k = 0; k < 3; ++k) {  // Gram–Schmidt, the longest rest first
    const Mat3 rest = b - H * b;
    int longest = 0;
    const double length = rest.colwise().norm().maxCoeff(&longest);
    if (length < same_direction) break;
    const Vec3 d = rest.col(longest) / length;
    H += d * d.transpose();
  }
  return std::round(H.trace()) == 3 ? Mat3(Mat3::Identity()) : H;
}

BoundaryData free_surface(const TriMesh& surface) {
  BoundaryData data;
  data.kind.assign(surface.triangle_count(), BoundaryKind::traction);
  data.traction.assign(surface.triangle_count(), Vec3::Zero());
  data.displacement.assign(surface.node_count(), Vec3::Zero());
  return data;
}

AmbientField uniform_stress(const Mat3& stress, double youngs_modulus, double poisson_ratio) {
  const Mat3 strain =
      ((1 + poisson_ratio) * stress - poisson_ratio * stress.trace() * Mat3::Identity()) / youngs_modulus;
  return {[stress](const Vec3&) { return stress; }, [strain](const Vec3& x) -> Vec3 { return strain * x; }};
}

}  // namespace conchoid
