#include "conchoid/sim/spread_force.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {

LinearTraction spread_force(const TriMesh& surface, const Region& region,
                            const BoundaryCondition& condition) {
  constexpr double on_a_line = 1e-9;  // × the largest second moment of area
  double area = 0;
  Vec3 center = Vec3::Zero();
  for (TriId t : region.triangles) {
    const double part = area_vector(surface, t).norm();
    area += part;
    center += part * centroid(surface, t);
  }
  center /= area;
  const Mat3 free = condition.free_directions();
  LinearTraction out{condition.load().value / area, Vec3::Zero(), center};
  if (condition.moment.isZero(0)) return out;
  Mat3 second = Mat3::Zero();
  for (TriId t : region.triangles) {
    const Vec3 d = centroid(surface, t) - center;
    const Mat3 arm = cross_matrix(d);
    second += area_vector(surface, t).norm() * (arm * free * arm.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(second);
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = eigen.eigenvectors().col(k);
    const double resists = eigen.eigenvalues()[k], moment = axis.dot(condition.moment);
    if (resists > on_a_line * eigen.eigenvalues()[2] && resists > 0)
      out.twist += moment / resists * axis;
    else if (std::abs(moment) > on_a_line * condition.moment.norm())
      throw InputError(
          fmt::format("{}: the triangles of region '{}' cannot carry the moment: about ({:.3g} {:.3g} "
                      "{:.3g}) no traction "
                      "in their centres turns, as far as its direction is free; widen the region, refine the "
                      "mesh there, or "
                      "leave a component \"free\" that turns",
                      condition.where, condition.region, axis[0], axis[1], axis[2]));
  }
  return out;
}

}  // namespace conchoid
