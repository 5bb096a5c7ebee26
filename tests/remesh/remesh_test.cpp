#include "conchoid/remesh/remesh.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"
#include "scans.hpp"

namespace conchoid {
namespace {

void expect_good(const TriMesh& mesh, const RemeshReport& report, int target) {
  EXPECT_NO_THROW(require_valid_body(mesh, "remeshed"));
  EXPECT_NEAR(static_cast<double>(mesh.triangle_count()), target, 0.1 * target);
  EXPECT_EQ(report.triangles, static_cast<int>(mesh.triangle_count()));
  EXPECT_NEAR(report.smallest_angle, smallest_angle_degrees(mesh), 1e-9);
}

// 1 deep, a unit long for each ridge, grooves of a half between ridges 1 high.
TriMesh grooved_slab(int ridges) {
  const int columns = 2 * ridges + 1;
  TriMesh mesh;
  for (int i = 0; i < columns; ++i)
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, i % 2 == 0 ? 0.5 : 1.0})
        mesh.positions.add({0.5 * i, y, z});
  const auto quad = [&mesh](int a, int b, int c, int d) {
    mesh.corners.push_back({NodeId(a), NodeId(b), NodeId(c)});
    mesh.corners.push_back({NodeId(a), NodeId(c), NodeId(d)});
  };
  const int last = 4 * (columns - 1);
  for (int i = 0; i < last; i += 4) {
    quad(i, i + 2, i + 6, i + 4);      // below
    quad(i + 1, i + 5, i + 7, i + 3);  // above
    quad(i, i + 4, i + 5, i + 1);
    quad(i + 2, i + 3, i + 7, i + 6);
  }
  quad(0, 1, 3, 2);
  quad(last, last + 2, last + 3, last + 1);
  return mesh;
}

TEST(Remesh, BallBecomesCoarserAndStaysABall) {
  const TriMesh ball = icosphere(1, 5);
  for (const int target : {200, 1000, 3000}) {
    RemeshReport report;
    const TriMesh mesh = remesh(ball, target, &report);
    expect_good(mesh, report, target);
    EXPECT_GT(report.smallest_angle, 25) << target;
    EXPECT_LT(report.hausdorff_distance, 12.0 / target) << target;
    EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(ball), 2.0 / target * enclosed_volume(ball));
  }
}

TEST(Remesh, BoxKeepsItsEdgesAndItsVolume) {
  const TriMesh box = box_mesh({1, 0.5, 0.25}, 1, 1, 1);  // 12 triangles become 1000
  RemeshReport report;
  const TriMesh mesh = remesh(box, 1000, &report);
  expect_good(mesh, report, 1000);
  EXPECT_GT(report.smallest_angle, 20);
  EXPECT_LT(report.hausdorff_distance, 1e-12);
  EXPECT_NEAR(enclosed_volume(mesh), 0.125, 1e-12);
}

TEST(Remesh, DetailedBoxKeepsItsEdgesToo) {
  const TriMesh box = box_mesh({1, 0.5, 0.25}, 40, 20, 10);
  RemeshReport report;
  const TriMesh mesh = remesh(box, 400, &report);
  expect_good(mesh, report, 400);
  EXPECT_GT(report.smallest_angle, 20);
  EXPECT_LT(report.hausdorff_distance, 1e-12);
  EXPECT_NEAR(enclosed_volume(mesh), 0.125, 1e-12);
}

TEST(Remesh, NotchedBarKeepsItsNotch) {
  const TriMesh bar = built_in_model("bar").mesh;
  RemeshReport report;
  const TriMesh mesh = remesh(bar, 900, &report);
  expect_good(mesh, report, 900);
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(bar), 1e-6 * enclosed_volume(bar));
  EXPECT_GT(report.smallest_angle, 15);
}

using RemeshScan = test::ScanTest;

TEST_P(RemeshScan, KeepsItsShapeInFewTriangles) {
  const TriMesh armadillo = read_mesh(GetParam().file);
  EXPECT_EQ(armadillo.triangle_count(), GetParam().triangles);
  EXPECT_NO_THROW(require_valid_body(armadillo, "armadillo.ply"));
  RemeshReport report;
  const TriMesh mesh = remesh(armadillo, GetParam().elements, &report);
  expect_good(mesh, report, GetParam().elements);
  RecordProperty("smallest_angle", std::to_string(report.smallest_angle));
  RecordProperty("hausdorff", std::to_string(report.hausdorff_distance));
  EXPECT_LE(report.below_15_degrees, 10);
  EXPECT_LT(report.hausdorff_distance, 0.05 * bounding_box(armadillo).diagonal());
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(armadillo), 0.05 * enclosed_volume(armadillo));
}

INSTANTIATE_TEST_SUITE_P(Scans, RemeshScan, testing::ValuesIn(test::scans()), test::scan_name);

TEST(Remesh, ScalingByAPowerOfTwoKeepsTheBits) {
  TriMesh ball = icosphere(1, 4);
  const TriMesh small = remesh(ball, 300);
  for (Vec3& x : ball.positions)
    x *= 1024;
  const TriMesh large = remesh(ball, 300);
  EXPECT_EQ(small.corners, large.corners);
  ASSERT_EQ(small.node_count(), large.node_count());
  for (std::size_t n = 0; n < small.node_count(); ++n)
    EXPECT_EQ(small.positions[NodeId(n)] * 1024, large.positions[NodeId(n)]);
}

TEST(Remesh, FarFromTheOriginGivesTheSameSurface) {
  TriMesh ball = icosphere(1, 4);
  for (Vec3& x : ball.positions)
    x += Vec3(1e4, 2e4, -1e4);
  RemeshReport report;
  const TriMesh mesh = remesh(ball, 300, &report);
  expect_good(mesh, report, 300);
  EXPECT_GT(report.smallest_angle, 25);
}

TEST(Remesh, TooFewTrianglesAreRefused) {
  EXPECT_THROW(remesh(icosphere(1, 2), 4), InputError);
}

// A slab with many grooves needs nodes along all of them: what it says that it allows is what can be had.
TEST(Remesh, CountThatAShapeDoesNotAllowTellsOneThatItDoes) {
  const TriMesh comb = grooved_slab(12);
  std::size_t allowed = 0;
  try {
    remesh(comb, 40);
  } catch (const TriangleCountError& error) {
    allowed = error.allowed();
    EXPECT_NE(std::string(error.what()).find(std::to_string(allowed)), std::string::npos) << error.what();
  }
  ASSERT_GT(allowed, 44u);
  EXPECT_FALSE(remesh_meets(40, allowed));
  const TriMesh mesh = remesh(comb, static_cast<int>(allowed));
  EXPECT_TRUE(remesh_meets(static_cast<int>(allowed), mesh.triangle_count()));
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(comb), 1e-3 * enclosed_volume(comb));
}

}  // namespace
}  // namespace conchoid
