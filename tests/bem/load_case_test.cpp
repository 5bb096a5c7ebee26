#include "conchoid/bem/load_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

TriMesh cube() {
  return box_mesh({1, 1, 1}, 2, 2, 2);
}

// Held at z-, where it may be displaced; the rest takes tractions.
std::vector<BoundaryKind> held_below(const TriMesh& mesh) {
  std::vector<BoundaryKind> kinds(mesh.triangle_count(), BoundaryKind::traction);
  for (std::size_t t = 0; t < kinds.size(); ++t)
    if (unit_normal(mesh, TriId(t)).z() < -0.9) kinds[t] = BoundaryKind::displacement;
  return kinds;
}

LoadCase no_load(const TriMesh& mesh) {
  return load_case(mesh, free_surface(mesh));
}

LoadCase pulled(const TriMesh& mesh, const Vec3& side, const Vec3& traction) {
  LoadCase load = no_load(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (unit_normal(mesh, TriId(t)).dot(side) > 0.9) load.traction[t] = traction;
  return load;
}

// The held face is stretched.
LoadCase stretched(const TriMesh& mesh) {
  LoadCase load = no_load(mesh);
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    if (const Vec3& x = mesh.positions[NodeId(i)]; x.z() < -0.49)
      load.displacement[NodeId(i)] = {1e-3 * x.x(), -4e-4 * x.y(), 2e-4};
  return load;
}

std::vector<LoadCase> three_loads(const TriMesh& mesh) {
  std::vector<LoadCase> loads{pulled(mesh, Vec3::UnitZ(), {0, 0, 1e6}),
                              pulled(mesh, Vec3::UnitX(), {3e5, 1e5, -2e5}), stretched(mesh)};
  loads[2].ambient = uniform_stress(1e5 * Mat3::Identity(), kGlassy.youngs_modulus, kGlassy.poisson_ratio);
  return loads;
}

CutComplex disc(const TriMesh& mesh, double radius) {
  return corefine(mesh, disc_crack({0.01, 0.02, 0.03}, Vec3::UnitZ(), radius, {.edge = 0.05}));
}

// A disc that runs out of the body at x+.
CutComplex edge_crack(const TriMesh& mesh, double radius) {
  return corefine(mesh, disc_crack({0.493, 0.02, 0.03}, Vec3::UnitZ(), radius, {.edge = 0.07}),
                  {.merge = 0.1});
}

std::vector<Vec3> state_of(const CrackedBody& body) {
  std::vector<Vec3> all(body.opening().begin(), body.opening().end());
  for (const Vec3& u : body.displacement())
    all.push_back(u);
  for (const Vec3& t : body.traction())
    all.push_back(t / kGlassy.youngs_modulus);
  return all;
}

double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    worst = std::max(worst, (a[i] - b[i]).norm());
    size = std::max(size, b[i].norm());
  }
  return worst / size;
}

}  // namespace

TEST(LoadCase, ANewLoadGivesWhatAFreshBodyGives) {
  const TriMesh mesh = cube();
  const auto body = std::make_shared<const BodyOperator>(mesh, held_below(mesh), kGlassy);
  CrackedBody kept(body, no_load(mesh));
  for (const LoadCase& load : three_loads(mesh)) {
    kept.set_load(load);
    kept.solve();
    CrackedBody fresh(std::make_shared<const BodyOperator>(mesh, held_below(mesh), kGlassy), load);
    fresh.solve();
    EXPECT_EQ(state_of(kept), state_of(fresh));
  }
}

TEST(LoadCase, ANewLoadOnAGrownCrackGivesWhatABodyGivesThatHadItFromTheStart) {
  const TriMesh mesh = cube();
  const auto body = std::make_shared<const BodyOperator>(mesh, held_below(mesh), kGlassy);
  for (const auto& crack : {disc, edge_crack}) {
    CrackedBody kept(body, no_load(mesh));
    for (double radius : {0.15, 0.25})
      kept.set_crack(crack(mesh, radius));
    const AppendStatistics before = kept.statistics();
    for (const LoadCase& load : three_loads(mesh)) {
      kept.set_load(load);
      kept.solve();
      CrackedBody fresh(body, load);
      for (double radius : {0.15, 0.25})
        fresh.set_crack(crack(mesh, radius));
      fresh.solve();
      EXPECT_LT(difference(state_of(kept), state_of(fresh)), 1e-12);
      double largest = 0;
      for (const Vec3& opening : kept.opening())
        largest = std::max(largest, opening.norm());
      EXPECT_GT(largest, 0) << "the crack feels the load";
    }
    EXPECT_EQ(kept.statistics().assembled, before.assembled) << "no row was made anew";
  }
}

TEST(LoadCase, OpeningsAreLinearInTheLoad) {
  const TriMesh mesh = cube();
  const auto body =
      std::make_shared<const BodyOperator>(mesh, held_below(mesh), kGlassy, BemSettings{.contact = false});
  const std::vector<LoadCase> loads = three_loads(mesh);
  LoadCase sum = no_load(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    sum.traction[t] = loads[0].traction[t] - 2 * loads[1].traction[t] + 3 * loads[2].traction[t];
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    sum.displacement[NodeId(i)] = 3 * loads[2].displacement[NodeId(i)];
  sum.ambient = uniform_stress(3e5 * Mat3::Identity(), kGlassy.youngs_modulus, kGlassy.poisson_ratio);
  CrackedBody cracked(body, loads[0]);
  cracked.set_crack(edge_crack(mesh, 0.25));
  std::vector<std::vector<Vec3>> states;
  for (const LoadCase& load : {loads[0], loads[1], loads[2], sum}) {
    cracked.set_load(load);
    cracked.solve();
    states.push_back(state_of(cracked));
  }
  std::vector<Vec3> combined = states[0];
  for (std::size_t i = 0; i < combined.size(); ++i)
    combined[i] += -2 * states[1][i] + 3 * states[2][i];
  EXPECT_LT(difference(combined, states[3]), 1e-10);
}

TEST(LoadCase, ManyRightHandSidesAtOnceAreTheSingleOnes) {
  const TriMesh mesh = cube();
  const BodyOperator body(mesh, held_below(mesh), kGlassy);
  const std::vector<LoadCase> loads = three_loads(mesh);
  const std::vector<BodyLoad> all = body.loads(loads);
  ASSERT_EQ(all.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const BodyLoad one = body.load(loads[i]);
    EXPECT_EQ(all[i].f_D, one.f_D);
    EXPECT_EQ(all[i].f_N, one.f_N);
  }
}

TEST(LoadCase, CrackedBodiesShareOneOperator) {
  const TriMesh mesh = cube();
  const auto body = std::make_shared<const BodyOperator>(mesh, held_below(mesh), kGlassy);
  std::vector<CrackedBody> bodies;
  for (int i = 0; i < 300; ++i)
    bodies.emplace_back(body, pulled(mesh, Vec3::UnitZ(), {0, 0, 1e3 * i}));
  for (const CrackedBody& one : bodies)
    EXPECT_EQ(&one.body(), body.get());
  EXPECT_EQ(body.use_count(), 301);
}

TEST(LoadCase, WhatDoesNotFitIsRefused) {
  const TriMesh mesh = cube();
  const auto kinds = held_below(mesh);
  EXPECT_THROW(BodyOperator(mesh, {BoundaryKind::traction}, kGlassy), InputError);
  const auto body = std::make_shared<const BodyOperator>(mesh, kinds, kGlassy);
  const auto refused = [&](auto change) {
    LoadCase load = no_load(mesh);
    change(load);
    EXPECT_THROW(CrackedBody(body, load), InputError);
    CrackedBody kept(body, pulled(mesh, Vec3::UnitZ(), {0, 0, 1e6}));
    kept.solve();
    const auto before = state_of(kept);
    EXPECT_THROW(kept.set_load(load), InputError);
    kept.solve();
    EXPECT_EQ(state_of(kept), before) << "the load is as it was";
  };
  const std::size_t held = std::find(kinds.begin(), kinds.end(), BoundaryKind::displacement) - kinds.begin();
  refused([](LoadCase& load) { load.traction.pop_back(); });
  refused([](LoadCase& load) { load.displacement.assign(1, Vec3::Zero()); });
  refused([&](LoadCase& load) { load.traction[held] = {1, 0, 0}; });
  refused([&](LoadCase& load) {
    for (std::size_t i = 0; i < mesh.node_count(); ++i)
      if (mesh.positions[NodeId(i)].z() > 0.49) load.displacement[NodeId(i)] = {0, 0, 1e-3};
  });
  refused([](LoadCase& load) { load.traction[0][1] = std::numeric_limits<double>::quiet_NaN(); });
}

}  // namespace conchoid
