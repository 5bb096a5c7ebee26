#include "conchoid/bem/body_force.hpp"

#include <Eigen/LU>
#include <cmath>

#include "conchoid/bem/pair_blocks.hpp"

namespace conchoid {
namespace {

// A field about the centre, of x − c.
struct Field {
  Vec3 displacement = Vec3::Zero();
  Mat3 stress = Mat3::Zero();
};

// σ = −s g e eᵀ along e = g/|g|, s = e·x: a column that hangs or stands under its own weight.
void add_column(const Vec3& g, const ElasticConstants& m, const Vec3& x, Field& out) {
  const double size = g.norm(), nu = m.poisson_ratio;
  if (size == 0) return;
  const Vec3 e = g / size;
  const double s = e.dot(x);
  const Vec3 across = x - s * e;
  out.stress -= s * size * e * e.transpose();
  out.displacement +=
      size / m.youngs_modulus * (nu * s * across - 0.5 * (s * s + nu * across.squaredNorm()) * e);
}

// u = −|x|² W x / 10μ for b = W x = w × x: shear alone.
void add_turning(const Vec3& w, const ElasticConstants& m, const Vec3& x, Field& out) {
  const double mu = m.shear_modulus(), factor = -1 / (10 * mu);
  const Vec3 b = cross(w, x);
  const Mat3 gradient = factor * (2 * b * x.transpose() + x.squaredNorm() * cross_matrix(w));
  out.displacement += factor * x.squaredNorm() * b;
  out.stress += mu * (gradient + gradient.transpose());
}

// Love's solution of a thin disc that turns about its axis e, without the part that is uniform in the plane:
//   σ_r = −|s|² ((3+ν)/8 r² + 3κ z²) ,  σ_θ = −|s|² ((1+3ν)/8 r² + 3κ z²) ,  κ = ν(1+ν) / 6(1−ν) ,  others zero
void add_disc(const Vec3& spin, const ElasticConstants& m, const Vec3& x, Field& out) {
  const double size = spin.squaredNorm(), nu = m.poisson_ratio;
  if (size == 0) return;
  const Vec3 e = spin / spin.norm();
  const double z = e.dot(x), kappa = nu * (1 + nu) / (6 * (1 - nu));
  const Vec3 across = x - z * e;
  const double r2 = across.squaredNorm();
  const Mat3 in_plane = Mat3::Identity() - e * e.transpose();
  out.stress -= size * (((1 + 3 * nu) / 8 * r2 + 3 * kappa * z * z) * in_plane +
                        (1 - nu) / 4 * across * across.transpose());
  out.displacement += size / m.youngs_modulus *
                      (nu * ((1 + nu) / 2 * r2 + 2 * kappa * z * z) * z * e -
                       ((1 - nu * nu) / 8 * r2 + nu * (1 + nu) / 2 * z * z) * across);
}

}  // namespace

BodyForce weight_and_spin(const Vec3& center, double density, const Vec3& gravity, const Vec3& omega,
                          const Vec3& on_axis) {
  const Vec3 arm = center - on_axis;
  return {center, density * (gravity + omega.squaredNorm() * arm - omega * omega.dot(arm)), Vec3::Zero(),
          std::sqrt(density) * omega};
}

BodyForce inertia_force(const TriMesh& surface, const Resultant& r) {
  const VolumeMoments p = volume_moments(surface);
  return {p.center, -r.force / p.volume, -(p.inertia.inverse() * r.moment), Vec3::Zero()};
}

AmbientField particular_field(const BodyForce& force, const ElasticConstants& m) {
  if (force.none()) return {};
  const auto at = [force, m](const Vec3& x) {
    Field out;
    add_column(force.uniform, m, x - force.center, out);
    add_turning(force.turning, m, x - force.center, out);
    add_disc(force.spin, m, x - force.center, out);
    return out;
  };
  return {[at](const Vec3& x) { return at(x).stress; }, [at](const Vec3& x) { return at(x).displacement; }};
}

Resultant with_body_force(const TriMesh& surface, Resultant r, const BodyForce& force) {
  if (force.none()) return r;
  const VolumeMoments p = volume_moments(surface);
  r.force += p.volume * force.uniform;
  r.moment += p.inertia * force.turning - cross(force.spin, p.inertia * force.spin);
  const double size = bounding_box(surface).diagonal();
  r.scale += p.volume * (force.uniform.norm() + size * (force.turning.norm() + force.spin.squaredNorm()));
  return r;
}

}  // namespace conchoid
