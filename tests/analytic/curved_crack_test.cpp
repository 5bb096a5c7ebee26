#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// Cracks that are not flat, given as mesh files, in the infinite body.
namespace conchoid {
namespace {

constexpr double kStress = 1e6;

// A disc of this radius bent over a sphere: lengths along the meridians are kept. The normal points outward.
TriMesh spherical_cap(double radius, double half_angle, int triangles) {
  TriMesh mesh = disc_crack(Vec3::Zero(), Vec3::UnitZ(), radius, {.triangles = triangles});
  const double R = radius / half_angle;
  for (Vec3& x : mesh.positions) {
    const double rho = std::hypot(x.x(), x.y()), theta = rho / R;
    if (rho == 0) continue;
    x = Vec3(R * std::sin(theta) * x.x() / rho, R * std::sin(theta) * x.y() / rho,
             -2 * R * std::pow(std::sin(theta / 2), 2));
  }
  return mesh;
}

// A long rectangle bent around an axis along x; its section is an arc of opening ±half_angle and chord 2a.
TriMesh long_arc(double a, double length, double half_angle, double edge) {
  const double R = half_angle > 0 ? a / std::sin(half_angle) : 0, width = half_angle > 0 ? R * half_angle : a;
  TriMesh mesh = rectangle_crack(Vec3::Zero(), {length, 0, 0}, {0, 2 * width, 0}, {.edge = edge});
  if (half_angle > 0)
    for (Vec3& x : mesh.positions) {
      const double theta = x.y() / R;
      x = Vec3(x.x(), R * std::sin(theta), -2 * R * std::pow(std::sin(theta / 2), 2));
    }
  return mesh;
}

TriMesh turned(TriMesh mesh, const Mat3& rotation) {
  for (Vec3& x : mesh.positions)
    x = (rotation * x).eval();
  return mesh;
}

std::vector<SifNode> sifs(const TriMesh& crack, const Mat3& stress) {
  const test::TemporaryFolder folder;
  const SifReport report = compute_sifs(
      test::scene_from_text("[body]\nmodel = 'infinite'\n" + test::material_text() +
                            test::mesh_crack_text(test::write_mesh_in(folder, "crack.ply", crack)) +
                            test::remote_stress_text(stress)));
  EXPECT_EQ(report.fronts.size(), 1u);
  return report.fronts.at(0).nodes;
}

Mat3 uniaxial(const Vec3& direction) {
  return kStress * direction * direction.transpose();
}

double largest_difference(const std::vector<SifNode>& a, const std::vector<SifNode>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, (a[i].intensity - b[i].intensity).norm());
  return most;
}

TEST(SphericalCap, BecomesTheFlatDiscAsItFlattens) {
  const Mat3 stress = uniaxial(Vec3(0.3, 0.2, 1).normalized());
  const auto flat = sifs(spherical_cap(0.5, 1e-9, 150), stress);
  const auto disc = sifs(disc_crack(Vec3::Zero(), Vec3::UnitZ(), 0.5, {.triangles = 150}), stress);
  ASSERT_EQ(flat.size(), disc.size());
  const double size = 2 * kStress * std::sqrt(0.5 / std::numbers::pi);
  EXPECT_LT(largest_difference(flat, disc), 1e-6 * size);
  // The change is linear in the angle: half the angle, half the change.
  const double wide = largest_difference(sifs(spherical_cap(0.5, 0.1, 150), stress), disc);
  const double half = largest_difference(sifs(spherical_cap(0.5, 0.05, 150), stress), disc);
  EXPECT_LT(wide, 0.12 * size);  // the front of the wide cap is turned by 0.1 rad
  EXPECT_NEAR(wide / half, 2, 0.3);
  RecordProperty("change", test::text(wide / size));
}

TEST(SphericalCap, SameUnderRotation) {
  const Mat3 rotation = test::arbitrary_rotation();
  const Mat3 stress = uniaxial(Vec3(0.5, -0.2, 1).normalized());
  const TriMesh cap = spherical_cap(0.5, 0.8, 150);
  const auto here = sifs(cap, stress);
  const auto there = sifs(turned(cap, rotation), rotation * stress * rotation.transpose());
  ASSERT_EQ(here.size(), there.size());
  EXPECT_LT(largest_difference(here, there), 1e-6 * kStress);
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_LT((there[i].position - rotation * here[i].position).norm(), 1e-14);
  RecordProperty("difference", test::text(largest_difference(here, there) / kStress));
}

TEST(SphericalCap, ConstantAlongTheFrontWhenPulledFromAllSides) {
  const auto nodes = sifs(spherical_cap(0.5, std::numbers::pi / 4, 384), kStress * Mat3::Identity());
  Vec3 mean = Vec3::Zero();
  for (const SifNode& node : nodes)
    mean += node.intensity / static_cast<double>(nodes.size());
  EXPECT_GT(mean[0], 0.5 * kStress * std::sqrt(0.5));
  EXPECT_GT(std::abs(mean[1]), 0.1 * mean[0]);
  double scatter = 0;
  for (const SifNode& node : nodes)
    scatter = std::max(scatter, (node.intensity - Vec3(mean[0], mean[1], 0)).cwiseAbs().maxCoeff());
  EXPECT_LT(scatter, 0.04 * mean[0]);
  RecordProperty("scatter", test::text(scatter / mean[0]));
  RecordProperty("K_II_over_K_I", test::text(mean[1] / mean[0]));
}

// Circular arc of chord 2a and half angle α in plane strain, pulled from all sides by σ (Cotterell & Rice
// 1980): K_I = σ√(πa) cos(α/2) / (1 + sin²(α/2)), K_II = σ√(πa) sin(α/2) / (1 + sin²(α/2)). The cracks are as
// long as ten half chords; what their ends take off is the same for the flat one.
TEST(LongArc, MiddleAgreesWithTheArcInThePlane) {
  const double a = 0.5, length = 5, alpha = std::numbers::pi / 4;
  const auto middle = [&](double half_angle) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const SifNode& node : sifs(long_arc(a, length, half_angle, 0.12), kStress * Mat3::Identity()))
      if (std::abs(node.position.x()) < 0.5) {
        sum += node.intensity.cwiseAbs();
        ++count;
      }
    return Vec3(sum / count);
  };
  const Vec3 flat = middle(0), arc = middle(alpha);
  const double down = 1 + std::pow(std::sin(alpha / 2), 2);
  EXPECT_NEAR(flat[0] / (kStress * std::sqrt(std::numbers::pi * a)), 1, 0.04);
  EXPECT_NEAR(arc[0] / flat[0], std::cos(alpha / 2) / down, 0.04);
  EXPECT_NEAR(arc[1] / flat[0], std::sin(alpha / 2) / down, 0.04);
  RecordProperty("flat", test::text(flat[0] / (kStress * std::sqrt(std::numbers::pi * a))));
  RecordProperty("K_I", test::text(arc[0] / flat[0] / (std::cos(alpha / 2) / down)));
  RecordProperty("K_II", test::text(arc[1] / flat[0] / (std::sin(alpha / 2) / down)));
}

}  // namespace
}  // namespace conchoid
