#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/bem/body_force.hpp"
#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/mesh/models.hpp"

using namespace conchoid;

namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

Mat3 hooke(const Mat3& gradient, const ElasticConstants& m) {
  const double mu = m.shear_modulus(), lambda = 2 * mu * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
  return lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
}

// A body under an affine displacement, displacement prescribed where `held` says so and traction elsewhere.
struct PatchResult {
  double displacement_error, traction_error, stress_error, inner_error;
};

PatchResult patch(const TriMesh& mesh, const std::function<bool(const Vec3&)>& held, bool rigid_removed) {
  Mat3 gradient;
  gradient << 1.0e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, 2e-4, 4e-4, 6e-4;
  const Mat3 stress = hooke(gradient, kGlassy);
  const Vec3 shift(1e-4, -2e-4, 3e-4);
  BoundaryData data = free_surface(mesh);
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    data.displacement[NodeId(i)] = gradient * mesh.positions[NodeId(i)] + shift;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    data.traction[t] = stress * unit_normal(mesh, TriId(t));
    if (held(centroid(mesh, TriId(t)))) {
      data.kind[t] = BoundaryKind::displacement;
      data.traction[t].setZero();
    }
  }
  const auto exact_displacement = data.displacement;
  CrackedBody body = make_cracked_body(mesh, data, kGlassy, {}, {1e-10, true});
  body.solve();
  PatchResult r{};
  auto u = body.displacement();
  if (rigid_removed) {
    const auto modes = floating_motions(mesh, data.kind);
    for (const auto& mode : modes) {
      double product = 0;
      for (std::size_t i = 0; i < u.size(); ++i)
        for (int k = 0; k < 3; ++k)
          product += mode[3 * i + k] * (u[NodeId(i)][k] - exact_displacement[NodeId(i)][k]);
      for (std::size_t i = 0; i < u.size(); ++i)
        for (int k = 0; k < 3; ++k)
          u[NodeId(i)][k] -= product * mode[3 * i + k];
    }
  }
  const double size = gradient.norm() * bounding_box(mesh).diagonal();
  for (std::size_t i = 0; i < u.size(); ++i)
    r.displacement_error =
        std::max(r.displacement_error, (u[NodeId(i)] - exact_displacement[NodeId(i)]).norm() / size);
  const auto t = body.traction();
  const auto s = body.surface_stress();
  for (std::size_t x = 0; x < mesh.triangle_count(); ++x) {
    const Vec3 exact = stress * unit_normal(mesh, TriId(x));
    r.traction_error = std::max(r.traction_error, (t[x] - exact).norm() / stress.norm());
    r.stress_error = std::max(r.stress_error, (s[x] - stress).norm() / stress.norm());
  }
  const Vec3 inside = 0.3 * bounding_box(mesh).center() + 0.7 * centroid(mesh, TriId(3)) * 0.5;
  r.inner_error = (body.interior_stress(inside) - stress).norm() / stress.norm();
  return r;
}

void expect_exact(const PatchResult& r) {
  EXPECT_LT(r.displacement_error, 1e-8);
  EXPECT_LT(r.traction_error, 1e-8);
  EXPECT_LT(r.stress_error, 1e-8);
  EXPECT_LT(r.inner_error, 1e-3);  // the inner stress integrates with a seven-point rule
}

}  // namespace

TEST(PatchTest, CubePureDisplacement) {
  expect_exact(patch(
      built_in_model("cube").mesh, [](const Vec3&) { return true; }, false));
}

TEST(PatchTest, CubePureTraction) {
  expect_exact(patch(
      built_in_model("cube").mesh, [](const Vec3&) { return false; }, true));
}

TEST(PatchTest, CubeMixed) {
  expect_exact(patch(
      built_in_model("cube").mesh, [](const Vec3& x) { return x.z() < -0.49; }, false));
}

TEST(PatchTest, CubeMixedPatchwise) {
  expect_exact(patch(
      built_in_model("cube").mesh, [](const Vec3& x) { return x.x() + 0.3 * x.y() > 0.2; }, false));
}

TEST(PatchTest, SphereMixed) {
  expect_exact(patch(
      icosphere(1.0, 1), [](const Vec3& x) { return x.y() > 0.3; }, false));
}

TEST(SurfaceStress, PressurisedSphereIsHydrostatic) {
  const TriMesh mesh = icosphere(2.0, 3);
  BoundaryData data = free_surface(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    data.traction[t] = -5e6 * unit_normal(mesh, TriId(t));
  CrackedBody body = make_cracked_body(mesh, data, kGlassy);
  body.solve();
  for (const Mat3& s : body.surface_stress())
    EXPECT_LT((s + 5e6 * Mat3::Identity()).norm(), 0.01 * 5e6);
}

// Sphere under σ·n = a x-independent load is only a patch test; a hollow sphere is not: Lamé's solution.
TEST(SurfaceStress, HollowSphereUnderInnerPressureFollowsLame) {
  const double a = 0.5, b = 1.0, pressure = 1e6;
  TriMesh mesh = icosphere(b, 2);
  const TriMesh inner = icosphere(a, 2);
  const std::size_t nodes = mesh.node_count(), outer_triangles = mesh.triangle_count();
  for (const Vec3& x : inner.positions)
    mesh.positions.push_back(x);
  for (const auto& c : inner.corners)
    mesh.corners.push_back(
        {NodeId(c[0].index() + nodes), NodeId(c[2].index() + nodes), NodeId(c[1].index() + nodes)});
  BoundaryData data = free_surface(mesh);
  for (std::size_t t = outer_triangles; t < mesh.triangle_count(); ++t)
    data.traction[t] = -pressure * unit_normal(mesh, TriId(t));
  CrackedBody body = make_cracked_body(mesh, data, kGlassy, {}, {1e-4, true});
  body.solve();
  const double hoop_outer = 1.5 * pressure * a * a * a / (b * b * b - a * a * a);
  const auto stress = body.surface_stress();
  double mean = 0;
  for (std::size_t t = 0; t < outer_triangles; ++t)
    mean += principal_stress(stress[t]).value[0] / static_cast<double>(outer_triangles);
  EXPECT_NEAR(mean / hoop_outer, 1, 0.03);
}

TEST(RigidBody, UnbalancedLoadIsSeenAndRelieved) {
  const TriMesh mesh = box_mesh({1, 1, 3}, 2, 2, 6);
  BoundaryData data = free_surface(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (centroid(mesh, TriId(t)).z() > 1.49) data.traction[t] = Vec3(0, 0, 1e6);
  const Resultant r = resultant(mesh, data);
  EXPECT_NEAR(r.force.z(), 1e6, 1);
  EXPECT_FALSE(balanced(r, mesh));
  // pulled at one end, the other following by inertia: σ_zz falls linearly from 1e6 at the end to 0 at the
  // other
  const AmbientField field = particular_field(inertia_force(mesh, r), kGlassy);
  BoundaryData rest = data;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    rest.traction[t] -= field.stress(centroid(mesh, TriId(t))) * unit_normal(mesh, TriId(t));
  EXPECT_LT(resultant(mesh, rest).force.norm(), 1e-9 * 1e6);
  CrackedBody body = make_cracked_body(mesh, rest, kGlassy, field);
  body.solve();
  for (double z : {-0.5, 0.0, 0.5})
    EXPECT_NEAR(body.interior_stress(Vec3(0.05, -0.1, z))(2, 2), 1e6 * (z + 1.5) / 3, 0.02e6);
}

TEST(RigidBody, RotationalInertiaFieldIsInEquilibrium) {
  const TriMesh mesh = box_mesh({1, 2, 3}, 2, 2, 2);
  const Resultant r{Vec3(1, -2, 0.5), Vec3(0.3, 0.4, -0.7), 1, Vec3::Zero()};
  const AmbientField field = particular_field(inertia_force(mesh, r), kGlassy);
  // force and moment of its own surface traction equal the load's: ∫σ n = F, ∫ x × σ n = M. Midpoint rule is
  // exact for the force of linear stress only, so integrate finely.
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const TriMesh fine = box_mesh({1, 2, 3}, 40, 40, 40);
  for (std::size_t t = 0; t < fine.triangle_count(); ++t) {
    const Vec3 x = centroid(fine, TriId(t)), f = field.stress(x) * area_vector(fine, TriId(t));
    force += f;
    moment += cross(x, f);
  }
  EXPECT_LT((force - r.force).norm(), 2e-3);
  EXPECT_LT((moment - r.moment).norm(), 2e-3);
}
