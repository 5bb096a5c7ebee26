#include "conchoid/bem/body_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

BodyForce some_force() {
  return {Vec3(0.2, -0.1, 0.3), Vec3(1e4, -2e4, 3e4), Vec3(2e4, 1e4, -3e4), Vec3(80, -120, 60)};
}

Vec3 force_at(const BodyForce& f, const Vec3& x) {
  const Vec3 y = x - f.center;
  return f.uniform + cross(f.turning, y) + f.spin.squaredNorm() * y - f.spin * f.spin.dot(y);
}

}  // namespace

TEST(BodyForce, TheParticularFieldObeysHookeAndIsInEquilibrium) {
  const BodyForce force = some_force();
  const AmbientField field = particular_field(force, kGlassy);
  const double mu = kGlassy.shear_modulus(),
               lambda = 2 * mu * kGlassy.poisson_ratio / (1 - 2 * kGlassy.poisson_ratio), h = 1e-3;
  for (const Vec3& x : {Vec3(0.7, -0.3, 0.5), Vec3(-0.4, 0.9, 0.1)}) {
    Vec3 divergence = Vec3::Zero();
    Mat3 gradient;
    for (int k = 0; k < 3; ++k) {  // central differences: exact for stress, which is quadratic
      const Vec3 d = h * Vec3::Unit(k);
      divergence += (field.stress(x + d) - field.stress(x - d)).col(k) / (2 * h);
      gradient.col(k) = (8 * (field.displacement(x + d) - field.displacement(x - d)) -
                         (field.displacement(x + 2 * d) - field.displacement(x - 2 * d))) /
                        (12 * h);
    }
    EXPECT_LT((divergence + force_at(force, x)).norm(), 1e-7 * force_at(force, x).norm());
    const Mat3 stress = lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
    EXPECT_LT((stress - field.stress(x)).norm(), 1e-7 * stress.norm());
  }
}

TEST(BodyForce, ItsResultantIsThatOfTheFieldsTraction) {
  const TriMesh mesh = box_mesh({1, 2, 3}, 2, 2, 2), fine = box_mesh({1, 2, 3}, 40, 40, 40);
  BodyForce force = some_force();
  force.center.setZero();
  const AmbientField field = particular_field(force, kGlassy);
  Vec3 f = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t t = 0; t < fine.triangle_count(); ++t) {
    const Vec3 x = centroid(fine, TriId(t)), part = field.stress(x) * area_vector(fine, TriId(t));
    f -= part;
    moment -= cross(x, part);
  }
  const Resultant r = with_body_force(mesh, {Vec3::Zero(), Vec3::Zero(), 0, Vec3::Zero()}, force);
  EXPECT_LT((f - r.force).norm(), 2e-3 * r.force.norm());
  EXPECT_LT((moment - r.moment).norm(), 2e-3 * r.moment.norm());
}

TEST(BodyForce, TurningAboutAnAxisAwayFromTheBodyPullsItOutward) {
  const Vec3 center(1, 2, 3), omega(0, 0, 10), gravity(0, 0, -9.81);
  const BodyForce force = weight_and_spin(center, 2000, gravity, omega, Vec3(0, 0, 50));
  for (const Vec3& x : {Vec3(0.5, 2.5, 3.5), Vec3(-1, 4, 0)})
    EXPECT_LT((force_at(force, x) - 2000 * Vec3(100 * x.x(), 100 * x.y(), -9.81)).norm(), 1e-6);
}

TEST(BodyForce, AFreeBodyUnderItsWeightFallsWithoutStress) {
  const TriMesh mesh = box_mesh({1, 2, 3}, 2, 2, 2);
  const BodyForce weight = weight_and_spin(Vec3::Zero(), 1200, {0, 3, -9}, Vec3::Zero(), Vec3::Zero());
  const Resultant r = with_body_force(mesh, resultant(mesh, free_surface(mesh)), weight);
  const BodyForce inertia = inertia_force(mesh, r);
  EXPECT_LT((weight.uniform + inertia.uniform).norm(), 1e-12 * weight.uniform.norm());
  EXPECT_LT(inertia.turning.norm(), 1e-12 * weight.uniform.norm());
}

}  // namespace conchoid
