#include "conchoid/bem/surface_stress.hpp"

#include <Eigen/Eigenvalues>

namespace conchoid {

Mat3 surface_stress(const Triangle& x, const std::array<Vec3, 3>& u, const Vec3& t,
                    const ElasticConstants& m) {
  const Vec3 n2 = area_vector2(x[0], x[1], x[2]);
  const double twice_area = n2.norm();
  const Vec3 n = n2 / twice_area;
  Mat3 gradient = Mat3::Zero();  // ∂u_i/∂x_j along the surface
  for (int k = 0; k < 3; ++k)
    gradient += u[k] * cross(n, x[(k + 2) % 3] - x[(k + 1) % 3]).transpose() / twice_area;
  const Mat3 in_plane = Mat3::Identity() - n * n.transpose();
  const Mat3 strain = in_plane * (0.5 * (gradient + gradient.transpose())) * in_plane;
  const double nu = m.poisson_ratio, ratio = nu / (1 - nu), normal = t.dot(n);
  const Vec3 shear = t - normal * n;
  return 2 * m.shear_modulus() * (strain + ratio * strain.trace() * in_plane) + ratio * normal * in_plane +
         normal * n * n.transpose() + shear * n.transpose() + n * shear.transpose();
}

Mat3 strain_of(const Mat3& stress, const ElasticConstants& m) {
  const double nu = m.poisson_ratio;
  return (stress - nu / (1 + nu) * stress.trace() * Mat3::Identity()) / (2 * m.shear_modulus());
}

PrincipalStress principal_stress(const Mat3& stress) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.compute(stress);
  PrincipalStress p;
  for (int k = 0; k < 3; ++k) {
    p.value[k] = solver.eigenvalues()[2 - k];
    p.direction.col(k) = solver.eigenvectors().col(2 - k);
  }
  return p;
}

}  // namespace conchoid
