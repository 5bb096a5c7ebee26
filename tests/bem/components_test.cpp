#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "arbitrary_rotation.hpp"
#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

// Conditions on single components of the displacement.
namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};
const Mat3 kTurn = test::arbitrary_rotation();
using Kinds = std::vector<BoundaryKind>;

BoundaryKind across(const Vec3& n) {
  return BoundaryKind::holding({&n, 1});
}

// Kinds by triangle, from its centre and normal.
Kinds kinds_by(const TriMesh& mesh, const std::function<BoundaryKind(const Vec3&, const Vec3&)>& rule) {
  Kinds kinds;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    kinds.push_back(rule(centroid(mesh, TriId(t)), unit_normal(mesh, TriId(t))));
  return kinds;
}

Mat3 hooke(const Mat3& gradient) {
  const double mu = kGlassy.shear_modulus(),
               lambda = 2 * mu * kGlassy.poisson_ratio / (1 - 2 * kGlassy.poisson_ratio);
  return lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
}

// Largest relative errors of an affine field whose own data are prescribed.
struct Errors {
  double stress = 0, traction = 0, displacement = 0;
};

Errors affine(const TriMesh& mesh, const Kinds& kinds, const std::string& solver = "dense") {
  Mat3 gradient;
  gradient << 1.0e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, 2e-4, 4e-4, 6e-4;
  const Mat3 stress = hooke(gradient);
  BoundaryData data = free_surface(mesh);
  data.kind = kinds;
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    data.displacement[NodeId(i)] = gradient * mesh.positions[NodeId(i)] + Vec3(1e-4, -2e-4, 3e-4);
  const auto exact = data.displacement;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    data.traction[t] = stress * unit_normal(mesh, TriId(t));
  CrackedBody body = make_cracked_body(mesh, data, kGlassy, {}, {1e-10, true, solver});
  body.solve();
  auto u = body.displacement();
  for (const auto& mode : floating_motions(mesh, kinds)) {
    double product = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      for (int k = 0; k < 3; ++k)
        product += mode[3 * i + k] * (u[NodeId(i)][k] - exact[NodeId(i)][k]);
    for (std::size_t i = 0; i < u.size(); ++i)
      for (int k = 0; k < 3; ++k)
        u[NodeId(i)][k] -= product * mode[3 * i + k];
  }
  Errors e;
  const double size = gradient.norm() * bounding_box(mesh).diagonal();
  for (std::size_t i = 0; i < u.size(); ++i)
    e.displacement = std::max(e.displacement, (u[NodeId(i)] - exact[NodeId(i)]).norm() / size);
  const auto s = body.surface_stress();
  const auto t = body.traction();
  for (std::size_t x = 0; x < t.size(); ++x) {
    e.traction = std::max(e.traction, (t[x] - data.traction[x]).norm() / stress.norm());
    e.stress = std::max(e.stress, (s[x] - stress).norm() / stress.norm());
  }
  return e;
}

void expect_exact(const Errors& e) {
  EXPECT_LT(e.displacement, 1e-8);
  EXPECT_LT(e.traction, 1e-8);
  EXPECT_LT(e.stress, 1e-8);
}

BoundaryKind rollers_on_three_planes(const Vec3&, const Vec3& n) {
  return n.minCoeff() < -0.9 ? across(n) : BoundaryKind::traction;
}

TriMesh turned(TriMesh mesh, const Mat3& by) {
  for (Vec3& x : mesh.positions)
    x = by * x;
  return mesh;
}

}  // namespace

TEST(Components, RollersOnThreePlanesHoldAndAreExact) {
  const TriMesh mesh = box_mesh({1, 1.2, 0.8}, 2, 2, 2);
  const Kinds kinds = kinds_by(mesh, rollers_on_three_planes);
  EXPECT_TRUE(free_motions(mesh, kinds, Vec3::Zero()).empty());
  for (const char* solver : {"dense", "iterative"})
    expect_exact(affine(mesh, kinds, solver));
}

TEST(Components, RollersInTurnedAxesAreExact) {
  const TriMesh mesh = turned(box_mesh({1, 1.2, 0.8}, 2, 2, 2), kTurn);
  const Kinds kinds = kinds_by(mesh, [](const Vec3& x, const Vec3& n) {
    return rollers_on_three_planes(kTurn.transpose() * x, kTurn.transpose() * n) == BoundaryKind::traction
               ? BoundaryKind::traction
               : across(n);
  });
  EXPECT_TRUE(free_motions(mesh, kinds, Vec3::Zero()).empty());
  expect_exact(affine(mesh, kinds));
}

TEST(Components, ARollerLeavesThreeMotionsThatAreTakenOut) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2);
  const Kinds kinds = kinds_by(
      mesh, [](const Vec3&, const Vec3& n) { return n.z() < -0.9 ? across(n) : BoundaryKind::traction; });
  const auto motions = free_motions(mesh, kinds, Vec3::Zero());
  ASSERT_EQ(motions.size(), 3u);
  for (const RigidMotion& m : motions) {
    EXPECT_NEAR(m.v.z(), 0, 1e-12);
    EXPECT_NEAR(m.omega.head<2>().norm(), 0, 1e-12);
  }
  for (const char* solver : {"dense", "iterative"})
    expect_exact(affine(mesh, kinds, solver));
}

TEST(Components, OneAndTwoComponentsBesideAFixedPatchAreExact) {
  const TriMesh mesh = icosphere(1, 1);
  const Vec3 pair[] = {kTurn.col(0), kTurn.col(1)};
  expect_exact(affine(mesh, kinds_by(mesh, [&](const Vec3& x, const Vec3&) {
                        return x.y() > 0.6    ? BoundaryKind::displacement
                               : x.x() > 0.5  ? across(kTurn.col(2))
                               : x.z() < -0.5 ? BoundaryKind::holding(pair)
                                              : BoundaryKind::traction;
                      })));
}

TEST(Components, ABodyMayBeHeldByItsCavityAlone) {
  TriMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2);
  const TriMesh inner = box_mesh({0.4, 0.4, 0.4}, 1, 1, 1);
  const std::size_t nodes = mesh.node_count(), outer = mesh.triangle_count();
  for (const Vec3& x : inner.positions)
    mesh.positions.push_back(x);
  for (const auto& c : inner.corners)
    mesh.corners.push_back(
        {NodeId(c[0].index() + nodes), NodeId(c[2].index() + nodes), NodeId(c[1].index() + nodes)});
  Kinds kinds(mesh.triangle_count(), BoundaryKind::traction);
  for (std::size_t t = outer; t < kinds.size(); ++t)
    kinds[t] = BoundaryKind::displacement;
  EXPECT_TRUE(floating_motions(mesh, kinds).empty());
  expect_exact(affine(mesh, kinds));
}

TEST(Components, JoinedProjectionsHoldBothSpaces) {
  const Mat3 x = across(Vec3::UnitX()).held(), y = across(Vec3::UnitY()).held();
  EXPECT_EQ(join_held(x, y), Mat3(Vec3(1, 1, 0).asDiagonal()));
  EXPECT_EQ(join_held(x, x), x);
  EXPECT_EQ(join_held(Mat3::Zero(), y), y);
  EXPECT_EQ(join_held(y, Mat3::Identity()), Mat3(Mat3::Identity()));
  const Mat3 a = across(kTurn.col(0)).held(), b = across(Vec3(1, 1, 1).normalized()).held(),
             both = join_held(a, b);
  EXPECT_LT((both * both - both).norm(), 1e-14);
  EXPECT_LT((both * a - a).norm() + (both * b - b).norm(), 1e-14);
  EXPECT_EQ(join_held(both, across(cross(kTurn.col(0), Vec3(1, 1, 1)).normalized()).held()),
            Mat3(Mat3::Identity()));
}

// Half of a body, with rollers on its plane of symmetry, in which a crack opens as it does in the whole.
TEST(Components, ACrackOpensOnAPlaneOfSymmetryAsInTheWholeBody) {
  const auto opened = [](const TriMesh& mesh, const Kinds& kinds, const TriMesh& disc) {
    BoundaryData data = free_surface(mesh);
    data.kind = kinds;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (const double z = unit_normal(mesh, TriId(t)).z(); std::abs(z) > 0.9)
        data.traction[t] = {0, 0, 1e6 * z};
    CrackedBody body = make_cracked_body(mesh, data, kGlassy);
    const CutComplex cut = corefine(mesh, disc, {.merge = 0.1});
    body.set_crack(cut);
    body.solve();
    double volume = 0, along = 0;
    for (const auto& c : cut.sheet) {
      const Vec3 n = 0.5 * area_vector2(cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]);
      for (NodeId node : c) {
        volume += n.dot(body.opening()[node]) / 3;
        if (std::abs(cut.positions[node].x()) < 1e-9)
          along = std::max(along, std::abs(body.opening()[node].x()));
      }
    }
    return std::pair(volume, along);
  };
  TriMesh whole = box_mesh({2, 2, 2}, 4, 4, 4), half = box_mesh({1, 2, 2}, 2, 4, 4);
  for (Vec3& x : half.positions)
    x.x() += 0.5;
  const TriMesh disc = disc_crack({0, 0.013, 0.017}, Vec3::UnitZ(), 0.4, {.edge = 0.1});
  const auto [full, none] = opened(whole, Kinds(whole.triangle_count()), disc);
  const auto [share, across_plane] = opened(
      half,
      kinds_by(half,
               [](const Vec3&, const Vec3& n) { return n.x() < -0.9 ? across(n) : BoundaryKind::traction; }),
      disc);
  EXPECT_NEAR(2 * share / full, 1, 0.03);
  EXPECT_EQ(across_plane, 0) << "the rollers let nothing move across them";
  const auto [pinned, at_rest] =
      opened(half,
             kinds_by(half,
                      [](const Vec3&, const Vec3& n) {
                        return n.x() < -0.9 ? BoundaryKind::displacement : BoundaryKind::traction;
                      }),
             disc);
  EXPECT_LT(2 * pinned / full, 0.9);
}

}  // namespace conchoid
