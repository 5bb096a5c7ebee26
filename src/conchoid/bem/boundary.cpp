#include "conchoid/bem/boundary.hpp"

#include <algorithm>

namespace conchoid {

bool BoundaryData::pure_traction() const {
  return std::none_of(kind.begin(), kind.end(),
                      [](BoundaryKind k) { return k == BoundaryKind::displacement; });
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
