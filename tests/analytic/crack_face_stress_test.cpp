#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/mesh/crack_meshes.hpp"

// Stress in the faces of a penny crack in the infinite body.
namespace conchoid {
namespace {

constexpr double kRadius = 0.5, kStress = 1e6, kNu = 0.327, kYoung = 3.1e9;
const ElasticConstants kMaterial{kYoung, kNu};

struct Face {
  Vec3 at;
  CrackFaceStress stress;
};

// Of all triangles within 0.7 of the radius.
std::vector<Face> faces_of_penny(const Mat3& remote) {
  CrackedBody body = make_cracked_body({}, {}, kMaterial, uniform_stress(remote, kYoung, kNu));
  const TriMesh disc = disc_crack(Vec3::Zero(), Vec3::UnitZ(), kRadius, {.triangles = 384});
  body.set_crack(uncut_sheet(disc));
  body.solve();
  std::vector<TriId> inner;
  for (std::size_t t = 0; t < disc.triangle_count(); ++t)
    if (centroid(disc, TriId(t)).norm() < 0.7 * kRadius) inner.emplace_back(t);
  const auto stress = body.crack_face_stress(inner);
  std::vector<Face> out;
  for (std::size_t i = 0; i < inner.size(); ++i)
    out.push_back({centroid(disc, inner[i]), stress[i]});
  return out;
}

// σ_rr = σ_θθ = −(1 + 2ν) σ/2 on both faces (Sneddon 1946), and what the body is pulled with along the crack.
TEST(CrackFaceStress, PennyUnderTension) {
  Mat3 remote = Mat3::Zero();
  remote.diagonal() << 2 * kStress, 0, kStress;
  const double sides = -(1 + 2 * kNu) / 2;
  const auto faces = faces_of_penny(remote);
  ASSERT_GT(faces.size(), 100u);
  double error = 0;
  for (const Face& f : faces)
    for (const Mat3& s : {f.stress.plus, f.stress.minus}) {
      Mat3 exact = Mat3::Zero();
      exact.diagonal() << 2 + sides, sides, 0;
      error = std::max(error, (s / kStress - exact).norm());
    }
  EXPECT_LT(error, 0.06);
  RecordProperty("error", std::to_string(error));
}

// Δu_x = 8(1−ν)τ/(π(2−ν)μ) √(a²−r²): the faces slide against each other and are stretched and pressed.
TEST(CrackFaceStress, PennyUnderShear) {
  Mat3 remote = Mat3::Zero();
  remote(0, 2) = remote(2, 0) = kStress;
  const double mu = kMaterial.shear_modulus();
  const double c = 8 * (1 - kNu) * kStress / (std::numbers::pi * (2 - kNu) * mu);
  const auto faces = faces_of_penny(remote);
  double error = 0, size = 0;
  for (const Face& f : faces) {
    const double root = std::sqrt(kRadius * kRadius - f.at.squaredNorm());
    Mat3 exact = Mat3::Zero();
    const double strain = -0.5 * c * f.at.x() / root, shear = -0.25 * c * f.at.y() / root;
    exact(0, 0) = 2 * mu * strain / (1 - kNu);
    exact(1, 1) = kNu * exact(0, 0);
    exact(0, 1) = exact(1, 0) = 2 * mu * shear;
    size = std::max(size, exact.norm());
    error = std::max({error, (f.stress.plus - exact).norm(), (f.stress.minus + exact).norm()});
  }
  EXPECT_LT(error, 0.12 * size);
  RecordProperty("error", std::to_string(error / size));
}

}  // namespace
}  // namespace conchoid
