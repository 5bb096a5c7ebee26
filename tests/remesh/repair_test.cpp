#include "conchoid/remesh/repair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/winding_number.hpp"
#include "conchoid/remesh/examine.hpp"
#include "conchoid/remesh/voxel_surface.hpp"
#include "mesh/mesh_checks.hpp"
#include "scans.hpp"

namespace conchoid {
namespace {

TriMesh cube() {
  return box_mesh(Vec3(1, 1, 1), 4, 4, 4);
}

/// The middle of the top removed: triangles with all corners within 0.3 of its centre.
TriMesh cube_with_hole() {
  TriMesh mesh = cube();
  std::erase_if(mesh.corners, [&](const auto& c) {
    for (NodeId n : c)
      if ((mesh.positions[n] - Vec3(0, 0, 0.5)).cwiseAbs().maxCoeff() > 0.3) return false;
    return true;
  });
  return mesh;
}

TriMesh overlapping_spheres() {
  TriMesh mesh = icosphere(1, 3);
  append(mesh, icosphere(1, 3), Vec3(1.02, 0.03, 0.05));
  return mesh;
}

/// Every triangle with nodes of its own.
TriMesh torn(const TriMesh& mesh) {
  TriMesh out;
  for (const auto& c : mesh.corners) {
    std::array<NodeId, 3> own;
    for (std::size_t k = 0; k < 3; ++k)
      own[k] = out.positions.add(mesh.positions[c[k]]);
    out.corners.push_back(own);
  }
  return out;
}

}  // namespace

TEST(Examine, AGoodCubeIsUsable) {
  const SurfaceReport report = examine(cube());
  EXPECT_TRUE(report.usable());
  EXPECT_EQ(report.triangles, 192u);
  EXPECT_NEAR(report.volume, 1, 1e-12);
  EXPECT_NEAR(report.area, 6, 1e-12);
  EXPECT_NEAR(report.shortest_edge, 0.25, 1e-12);
  EXPECT_NEAR(report.longest_edge, 0.25 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(report.smallest_angle, std::numbers::pi / 4, 1e-12);
  EXPECT_TRUE(report.holes.empty());
  ASSERT_EQ(report.parts.size(), 1u);
  EXPECT_TRUE(report.parts[0].closed && !report.parts[0].inside_out() && !report.parts[0].cavity());
  ASSERT_TRUE(report.advice);
  EXPECT_NEAR(report.advice->crack, 0.1, 1e-12);
  EXPECT_LT(report.advice->surface, report.advice->crack);
}

TEST(Examine, TheLongestExtentTellsTheUnit) {
  EXPECT_EQ(guess_unit(1).unit, "m");
  EXPECT_EQ(guess_unit(150).unit, "mm or cm");
  EXPECT_NE(guess_unit(150).why.find("0.15 m if these are mm"), std::string::npos) << guess_unit(150).why;
  EXPECT_EQ(guess_unit(1500).unit, "mm");
  EXPECT_EQ(guess_unit(1500).scale, 0.001);
}

TEST(Examine, AHoleIsALoopWithLengthAndPlace) {
  const SurfaceReport report = examine(cube_with_hole());
  EXPECT_FALSE(report.usable());
  ASSERT_EQ(report.holes.size(), 1u);
  EXPECT_EQ(report.holes[0].edges, 8u);
  EXPECT_NEAR(report.holes[0].length, 2, 1e-12);
  EXPECT_LT((report.holes[0].center - Vec3(0, 0, 0.5)).norm(), 1e-12);
  EXPECT_EQ(report.defect_counts.at(DefectKind::open_edge), 8u);
  EXPECT_NEAR(report.volume, 1, 1e-12) << "with the hole filled";
  EXPECT_FALSE(report.parts[0].closed);
}

TEST(Examine, FlippedTrianglesAreNoHoles) {
  TriMesh mesh = cube_with_hole();
  for (std::size_t t = 0; t < mesh.triangle_count(); t += 3)
    std::swap(mesh.corners[TriId(t)][0], mesh.corners[TriId(t)][1]);
  const SurfaceReport report = examine(mesh);
  ASSERT_EQ(report.holes.size(), 1u);
  EXPECT_EQ(report.holes[0].edges, 8u);
  EXPECT_GT(report.defect_counts.at(DefectKind::inconsistent_edge), 100u);
}

TEST(Examine, IntersectionsAreCountedAndPlaced) {
  const SurfaceReport report = examine(overlapping_spheres());
  EXPECT_GT(report.intersections.size(), 50u);
  EXPECT_EQ(report.defect_counts.at(DefectKind::self_intersection), report.intersections.size());
  for (const Intersection& at : report.intersections) {
    EXPECT_NEAR(at.where.x(), 0.51, 0.25) << "the spheres meet in the plane between them";
    EXPECT_LT(at.s, at.t);
  }
  EXPECT_EQ(report.parts.size(), 2u);
}

TEST(Examine, AllThatIsWrongIsListedAtOnce) {
  TriMesh mesh = overlapping_spheres();
  append(mesh, flipped(icosphere(0.5, 1)), Vec3(0, 5, 0));
  append(mesh, cube_with_hole(), Vec3(0, 0, 5));
  mesh.positions.push_back(Vec3(9, 9, 9));
  const SurfaceReport report = examine(mesh);
  for (const DefectKind kind : {DefectKind::self_intersection, DefectKind::inside_out, DefectKind::open_edge,
                                DefectKind::unused_node})
    EXPECT_TRUE(report.defect_counts.contains(kind)) << name_of(kind);
}

TEST(Examine, PartsKnowCavitiesAndWhichWayTheyAreOriented) {
  TriMesh mesh = icosphere(1, 2);
  append(mesh, flipped(icosphere(0.5, 2)));
  append(mesh, icosphere(0.5, 2), Vec3(3, 0, 0));
  append(mesh, flipped(icosphere(0.5, 2)), Vec3(0, 3, 0));
  const SurfaceReport report = examine(mesh);
  ASSERT_EQ(report.parts.size(), 4u);
  EXPECT_FALSE(report.parts[0].cavity() || report.parts[0].inside_out());
  EXPECT_TRUE(report.parts[1].cavity());
  EXPECT_FALSE(report.parts[1].inside_out());
  EXPECT_FALSE(report.parts[2].cavity() || report.parts[2].inside_out());
  EXPECT_TRUE(report.parts[3].inside_out());
  EXPECT_EQ(report.defect_counts.at(DefectKind::inside_out), 1u);
}

TEST(Repair, AGoodMeshComesBackAsItIs) {
  const TriMesh mesh = cube();
  const Repair repair = repaired(mesh, 0.1);
  EXPECT_EQ(repair.method, RepairMethod::none);
  EXPECT_EQ(repair.mesh.positions, mesh.positions);
  EXPECT_EQ(repair.mesh.corners, mesh.corners);
}

TEST(Repair, WhatCanBeTidiedIsNotMoved) {
  const TriangleSoup good = triangle_soup(cube());
  TriMesh turned = cube(), doubled = cube(), unused = cube();
  for (std::size_t t : {7u, 8u, 100u})
    std::swap(turned.corners[TriId(t)][0], turned.corners[TriId(t)][1]);
  doubled.corners.push_back(doubled.corners[TriId(3)]);
  unused.positions.push_back(Vec3(5, 5, 5));
  const std::vector<TriMesh> broken = {turned, doubled, unused, flipped(cube()), torn(cube())};
  for (std::size_t i = 0; i < broken.size(); ++i) {
    EXPECT_FALSE(find_defects(broken[i]).empty()) << i;
    const Repair repair = repaired(broken[i]);
    EXPECT_EQ(repair.method, RepairMethod::tidying) << i;
    EXPECT_EQ(needed_repair(broken[i]), RepairMethod::tidying) << i;
    EXPECT_TRUE(find_defects(repair.mesh).empty()) << i;
    EXPECT_EQ(triangle_soup(repair.mesh), good) << i;
  }
  EXPECT_EQ(repaired(turned).tidying.turned_triangles, 3u);
  EXPECT_EQ(repaired(doubled).tidying.removed_triangles, 1u);
  EXPECT_EQ(repaired(unused).tidying.removed_nodes, 1u);
  EXPECT_EQ(repaired(torn(cube())).tidying.merged_nodes, 192u * 3 - cube().node_count());
}

TEST(Repair, ACavityThatPointsOutwardIsTurned) {
  TriMesh mesh = cube();
  append(mesh, icosphere(0.25, 2));
  const Repair repair = repaired(mesh);
  EXPECT_EQ(repair.method, RepairMethod::tidying);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_NEAR(repair.volume_after, 1 - enclosed_volume(icosphere(0.25, 2)), 1e-12);
}

TEST(Repair, TheHoleOfACubeIsFilled) {
  const Repair repair = repaired(cube_with_hole(), 0.04);
  EXPECT_EQ(repair.method, RepairMethod::level_set);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_EQ(repair.filled_holes, 1u);
  EXPECT_EQ(surface_parts(repair.mesh).size(), 1u);
  EXPECT_NEAR(repair.volume_before, 1, 1e-12);
  EXPECT_NEAR(repair.volume_after, 1, 0.02) << "the edges are rounded off";
  EXPECT_LT(repair.moved, 0.04);
  EXPECT_LT(repair.lost, 0.06) << "corners of the cube, by less than √3 voxels";
}

TEST(Repair, OverlappingSpheresBecomeOneBody) {
  const double h = 0.05;
  const Repair repair = repaired(overlapping_spheres(), h);
  EXPECT_EQ(repair.method, RepairMethod::level_set);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_EQ(surface_parts(repair.mesh).size(), 1u);
  const double d = Vec3(1.02, 0.03, 0.05).norm(), pi = std::numbers::pi;
  const double lens = pi * (4 + d) * (2 - d) * (2 - d) / 12;
  EXPECT_NEAR(repair.volume_after, 8 * pi / 3 - lens, 0.02 * (8 * pi / 3 - lens));
  EXPECT_LT(repair.moved, h);
  EXPECT_GT(repair.lost, 0.4) << "the walls inside are gone, and the report says how far in they were";
}

TEST(Repair, ACavityStaysWhenTheOutsideIsMended) {
  TriMesh mesh = cube_with_hole();
  append(mesh, flipped(icosphere(0.25, 2)));
  const Repair repair = repaired(mesh, 0.04);
  EXPECT_EQ(repair.method, RepairMethod::level_set);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  const std::vector<SurfacePart> parts = surface_parts(repair.mesh);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_TRUE(parts[0].cavity() != parts[1].cavity());
  EXPECT_NEAR(repair.volume_after, 1 - enclosed_volume(icosphere(0.25, 2)), 0.02);
}

TEST(Repair, FlippedAndHoledAtOnce) {
  TriMesh mesh = flipped(cube_with_hole());
  for (std::size_t t = 0; t < mesh.triangle_count(); t += 5)
    std::swap(mesh.corners[TriId(t)][0], mesh.corners[TriId(t)][1]);
  const Repair repair = repaired(mesh, 0.04);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_NEAR(repair.volume_after, 1, 0.02);
}

TEST(Repair, AnInnerWallDisappears) {
  TriMesh mesh = box_mesh(Vec3(1, 1, 1), 2, 2, 2);
  append(mesh, box_mesh(Vec3(1, 1, 1), 2, 2, 2), Vec3(1, 0, 0));
  const Repair repair = repaired(mesh, 0.05);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_EQ(surface_parts(repair.mesh).size(), 1u);
  EXPECT_NEAR(repair.volume_after, 2, 0.03);
}

TEST(Repair, TheLatticeAgreesWithTheWindingNumber) {
  TriMesh mesh = overlapping_spheres();
  append(mesh, box_mesh(Vec3(1, 1, 1), 2, 2, 2), Vec3(0.5, 1, 0));
  const InsideLattice lattice = inside_lattice(mesh, 0.17);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < lattice.inside.size(); ++i) {
    EXPECT_EQ(lattice.inside[i] == 1, winding_number(mesh, lattice.point(i)) > 0.5) << i;
    inside += lattice.inside[i];
  }
  EXPECT_GT(inside, 500u);
}

TEST(Repair, AnyPatternOfPointsHasACleanBoundary) {
  // Patterns as wild as they get: the construction may not depend on the surface being tame.
  InsideLattice lattice;
  lattice.voxel = 1;
  lattice.size = {9, 8, 7};
  lattice.inside.assign(9 * 8 * 7, 0);
  std::uint32_t state = 12345;
  for (std::size_t k = 1; k < 6; ++k)
    for (std::size_t j = 1; j < 7; ++j)
      for (std::size_t i = 1; i < 8; ++i) {
        state = 1664525 * state + 1013904223;
        lattice.inside[lattice.index(i, j, k)] = (state >> 16) & 1;
      }
  for (const MeshDefect& defect : find_defects(lattice_boundary(lattice, icosphere(3, 1))))
    ADD_FAILURE() << defect.what;
}

TEST(Repair, TheSameBitsForEveryThreadCount) {
  const TriMesh one = ExecutionContext(1).run([] { return repaired(overlapping_spheres(), 0.1).mesh; });
  const TriMesh all = repaired(overlapping_spheres(), 0.1).mesh;
  EXPECT_EQ(one.positions, all.positions);
  EXPECT_EQ(one.corners, all.corners);
}

TEST(Repair, ScalingByAPowerOfTwoChangesNoBit) {
  TriMesh large = cube_with_hole();
  for (Vec3& x : large.positions)
    x *= 1024;
  const TriMesh a = repaired(cube_with_hole(), 0.0625).mesh, b = repaired(large, 64).mesh;
  ASSERT_EQ(a.corners, b.corners);
  for (std::size_t n = 0; n < a.node_count(); ++n)
    EXPECT_EQ(1024 * a.positions[NodeId(n)], b.positions[NodeId(n)]);
}

TEST(Repair, WhatCannotBeRepairedIsRefused) {
  EXPECT_THROW(repaired(TriMesh()), InputError);
  EXPECT_THROW(repaired(cube_with_hole(), 1e-4), InputError) << "more than 600³ points";
  TriMesh sheet;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
    sheet.positions.push_back(x);
  sheet.corners = {{NodeId(0), NodeId(1), NodeId(2)}, {NodeId(0), NodeId(2), NodeId(3)}};
  EXPECT_THROW(repaired(sheet), ComputationError) << "a sheet bounds no volume";
}

using RepairScan = test::ScanTest;

TEST_P(RepairScan, WithHolesIsMended) {
  TriMesh mesh = read_mesh(GetParam().file);
  const SurfaceReport good = examine(mesh);
  EXPECT_TRUE(good.usable());
  std::size_t t = 0;
  const std::size_t between = mesh.triangle_count() / 20;
  std::erase_if(mesh.corners, [&](const auto&) { return t++ % between < 3; });
  EXPECT_GT(examine(mesh).holes.size(), 10u);
  const double h = (good.box.high - good.box.low).maxCoeff() / 100;
  const Repair repair = repaired(mesh, h);
  EXPECT_EQ(repair.method, RepairMethod::level_set);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_NEAR(repair.volume_after, good.volume, 0.02 * good.volume);
  EXPECT_LT(repair.moved, 1.5 * h);
}

INSTANTIATE_TEST_SUITE_P(Scans, RepairScan, testing::ValuesIn(test::scans()), test::scan_name);

}  // namespace conchoid
