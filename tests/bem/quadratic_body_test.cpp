#include "conchoid/bem/quadratic_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/bem/quadratic_stress.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlass{7e10, 0.22};
const Vec3 kMiddle(1.0 / 3, 1.0 / 3, 1.0 / 3);

/// Pure bending about y: every quadratic displacement is followed exactly, and so is a linear traction.
AmbientField bending(double curvature, double sign) {
  const double nu = kGlass.poisson_ratio, k = sign * curvature;
  return {[=](const Vec3& x) {
            Mat3 s = Mat3::Zero();
            s(0, 0) = kGlass.youngs_modulus * k * x.z();
            return s;
          },
          [=](const Vec3& x) {
            return Vec3(k * x.x() * x.z(), -nu * k * x.y() * x.z(),
                        -k / 2 * (x.x() * x.x() + nu * (x.z() * x.z() - x.y() * x.y())));
          }};
}

using Held = std::function<BoundaryKind(const Vec3& centroid)>;

/// The load under which elements must cancel an ambient field: nothing moves where it is held, nothing is pulled
/// elsewhere.
LoadCase cancelling(const TriMesh& mesh, const std::vector<BoundaryKind>& kinds, const AmbientField& field) {
  BoundaryData data = free_surface(mesh);
  data.kind = kinds;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    data.traction[t] = -(field.stress(centroid(mesh, TriId(t))) * unit_normal(mesh, TriId(t)));
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    data.displacement[NodeId(i)] = -field.displacement(mesh.positions[NodeId(i)]);
  return load_case(mesh, data, field);
}

std::vector<BoundaryKind> kinds_where(const TriMesh& mesh, const Held& held) {
  std::vector<BoundaryKind> kinds;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    kinds.push_back(held(centroid(mesh, TriId(t))));
  return kinds;
}

struct Errors {
  double displacement = 0, traction = 0, stress = 0;  ///< relative to the largest of the field
};

Errors errors_of(const TriMesh& mesh, const Held& held, const AmbientField& field) {
  const std::vector<BoundaryKind> kinds = kinds_where(mesh, held);
  const QuadraticBody body(mesh, kinds, kGlass, 1e-9);
  const QuadraticSolution solution = body.solve(cancelling(mesh, kinds, field));
  const QuadraticSpace& space = body.space();
  Errors e;
  double displacement = 0, stress = 0;
  for (std::size_t i = 0; i < space.positions.size(); ++i) {
    const Vec3 u = field.displacement(space.positions[i]);
    displacement = std::max(displacement, u.norm());
    e.displacement = std::max(e.displacement, (solution.displacement[i] + u).norm());
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Panel& panel = space.corners.panels[t];
    for (int k = 0; k < 3; ++k) {
      const Mat3 s = field.stress(panel.x[k]);
      stress = std::max(stress, s.norm());
      e.traction = std::max(e.traction, (solution.traction[t][k] + s * panel.normal).norm());
      e.stress = std::max(e.stress, surface_stress(solution, TriId(t), Vec3::Unit(k)).norm());
    }
  }
  return {e.displacement / displacement, e.traction / stress, e.stress / stress};
}

void expect_exact(const Errors& e) {
  EXPECT_LT(e.displacement, 1e-6);
  EXPECT_LT(e.traction, 1e-6);
  EXPECT_LT(e.stress, 1e-6);
}

TEST(QuadraticBody, BendsExactlyClampedAtOneEnd) {
  expect_exact(errors_of(
      box_mesh({1, 0.4, 0.2}, 4, 2, 1),
      [](const Vec3& x) { return x.x() < -0.499 ? BoundaryKind::displacement : BoundaryKind::traction; },
      bending(0.1, 1)));
}

TEST(QuadraticBody, BendsExactlyHeldAllAround) {
  expect_exact(errors_of(
      box_mesh({1, 0.4, 0.2}, 3, 2, 1), [](const Vec3&) { return BoundaryKind::displacement; },
      bending(0.1, 1)));
}

TEST(QuadraticBody, BendsExactlyOnSingleComponents) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  expect_exact(errors_of(
      box_mesh({1, 0.4, 0.2}, 4, 2, 1),
      [&](const Vec3& c) {
        const double across = std::sqrt(0.5);
        if (c.x() < -0.499) return BoundaryKind::holding(std::array{x});
        if (c.x() > 0.499) return BoundaryKind::holding(std::array{z, y});
        if (c.y() > 0.199) return BoundaryKind::holding(std::array{Vec3(across * (y + z))});
        return BoundaryKind::traction;
      },
      bending(0.1, 1)));
}

/// Without supports the solution is the one without rigid motion, so only the stress is compared.
TEST(QuadraticBody, BendsExactlyUnderTractionAlone) {
  const Errors e = errors_of(
      box_mesh({1, 0.4, 0.2}, 4, 2, 1), [](const Vec3&) { return BoundaryKind::traction; }, bending(0.1, 1));
  EXPECT_LT(e.stress, 1e-6);
}

TEST(QuadraticBody, StretchesTurnedBodiesExactly) {
  Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), stress;
  stress << 3, 1, -2, 1, 4, 0.5, -2, 0.5, -1;
  TriMesh mesh = icosphere(1.0, 1);
  for (Vec3& p : mesh.positions)
    p = turn * Vec3(p.x(), 0.5 * p.y(), 0.3 * p.z());
  expect_exact(errors_of(
      mesh, [](const Vec3& c) { return c.x() > 0.3 ? BoundaryKind::displacement : BoundaryKind::traction; },
      uniform_stress(stress, kGlass.youngs_modulus, kGlass.poisson_ratio)));
}

/// Inside, near the faces and on them, of a bar whose elements are four times as long as it is thick.
TEST(QuadraticBody, FieldInsideIsThatOfTheSurface) {
  const TriMesh mesh = box_mesh({1, 0.4, 0.05}, 5, 2, 1);
  const AmbientField exact = bending(0.1, 1);
  const auto kinds = kinds_where(mesh, [](const Vec3& x) {
    return x.x() < -0.499 ? BoundaryKind::displacement : BoundaryKind::traction;
  });
  const QuadraticBody body(mesh, kinds, kGlass, 1e-8);
  const AmbientField rest =
      field_of(body.solve(cancelling(mesh, kinds, exact)));  // of what cancels `exact`: nothing
  const double size = exact.stress(Vec3(0, 0, 0.025)).norm();
  const double displaced = exact.displacement(Vec3(0.5, 0, 0)).norm();
  for (const double z : {-0.025, -0.0249, -0.024, -0.015, 0.0, 0.01, 0.02, 0.0245, 0.025})
    for (const Vec3& at : {Vec3(0.13, 0.07, z), Vec3(-0.2, -0.05, z), Vec3(0, 0, z)}) {
      EXPECT_LT(rest.stress(at).norm(), 5e-3 * size) << at.transpose();
      EXPECT_LT(rest.displacement(at).norm(), 5e-3 * displaced) << at.transpose();
    }
}

/// A cantilever of elements more than three times as long as it is thick: linear ones show 0.4 of the stress.
TEST(QuadraticBody, CantileverShowsItsStress) {
  const double length = 1, width = 0.3, thickness = 0.03, force = 100;
  const TriMesh mesh = box_mesh({length, width, thickness}, 10, 3, 1);
  BoundaryData data = free_surface(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 c = centroid(mesh, TriId(t));
    if (c.x() < -0.499) data.kind[t] = BoundaryKind::displacement;
    if (c.x() > 0.499) data.traction[t] = Vec3(0, 0, -force / (width * thickness));
  }
  const QuadraticBody body(mesh, data.kind, kGlass);
  const QuadraticSolution solution = body.solve(load_case(mesh, data));
  double shown = 0, theory = 0, down = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 c = centroid(mesh, TriId(t));
    if (c.z() < thickness / 2 - 1e-9 || std::abs(c.x()) > 0.25) continue;
    shown += surface_stress(solution, TriId(t), kMiddle)(0, 0);
    theory += force * (length / 2 - c.x()) / (width * thickness * thickness / 6);
  }
  for (const Vec3& u : solution.displacement)
    down = std::max(down, -u.z());
  const double deflection = 4 * force / (kGlass.youngs_modulus * width * std::pow(thickness, 3));
  RecordProperty("stress", std::to_string(shown / theory));
  RecordProperty("deflection", std::to_string(down / deflection));
  EXPECT_NEAR(shown / theory, 1, 0.03);
  EXPECT_NEAR(down / deflection, 1, 0.05);
}

}  // namespace
}  // namespace conchoid
