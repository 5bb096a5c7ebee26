#include "conchoid/remesh/weld.hpp"

#include <gtest/gtest.h>

#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

/// Every triangle with nodes of its own, up to `off` away.
TriMesh loose(const TriMesh& mesh, double off) {
  TriMesh out;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<NodeId, 3> own;
    for (std::size_t k = 0; k < 3; ++k)
      own[k] = out.positions.add(mesh.triangle(TriId(t))[k] + off * Vec3(static_cast<double>(t % 3) / 3,
                                                                         static_cast<double>(t % 2) / 2, 0));
    out.corners.push_back(own);
  }
  return out;
}

}  // namespace

TEST(Weld, ClosesLooseSeamsInAnyUnit) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    TriMesh mesh = loose(icosphere(1, 2), 1e-6);
    for (Vec3& x : mesh.positions)
      x *= scale;
    WeldReport report;
    const AttributedMesh out = welded_if_it_helps({mesh, {}}, report);
    EXPECT_TRUE(find_defects(out.mesh).empty()) << scale;
    EXPECT_EQ(out.mesh.triangle_count(), mesh.triangle_count());
    EXPECT_GT(report.nodes, 0u);
    EXPECT_LT(report.farthest, 2e-6 * scale);
  }
}

TEST(Weld, LeavesGoodSurfacesAndThinGapsAlone) {
  TriMesh mesh = box_mesh(Vec3(1, 1, 1), 2, 2, 2);
  append(mesh, box_mesh(Vec3(1, 1, 1), 2, 2, 2), Vec3(1 + 1e-6, 0, 0));  // a gap far below the weld's reach
  WeldReport report;
  EXPECT_EQ(welded_if_it_helps({mesh, {}}, report).mesh.positions, mesh.positions);
  EXPECT_EQ(report.nodes, 0u);
  mesh.corners.pop_back();  // with a hole somewhere it stays, too
  WeldReport with_hole;
  welded(mesh, with_hole);
  EXPECT_EQ(with_hole.nodes, 0u);
}

TEST(Weld, WhatItCannotCloseComesBackAsItIs) {
  const TriMesh mesh = loose(icosphere(1, 2), 0.05);
  WeldReport report;
  EXPECT_EQ(welded_if_it_helps({mesh, {}}, report).mesh.positions, mesh.positions);
  EXPECT_EQ(report.nodes, 0u);
}

}  // namespace conchoid
