#include "conchoid/remesh/wall_resolution.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/wall_thickness.hpp"
#include "conchoid/remesh/examine.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/validate.hpp"
#include "hollow_bodies.hpp"
#include "refusal.hpp"

namespace conchoid {
namespace {

TEST(WallResolution, StoutBodiesAreNotWarnedOf) {
  for (const char* model : {"cube", "cylinder", "bar", "edge-crack-cube"})
    EXPECT_FALSE(coarse_walls(built_in_model(model).mesh)) << model;
  EXPECT_FALSE(coarse_walls(box_mesh({1, 1, 1}, 1, 1, 1)));
  EXPECT_FALSE(coarse_walls(icosphere(1, 2)));
}

TEST(WallResolution, AChiselIsThinAtItsEdgeOnlyAndNotWarnedOf) {
  TriMesh wedge = box_mesh({1, 1, 0.5}, 10, 10, 5);
  for (Vec3& x : wedge.positions)
    x.z() *= 0.02 + (0.5 - x.x());  // 1 % thick at its edge
  const auto walls = coarse_walls(wedge);
  EXPECT_TRUE(!walls || walls->share < 0.2);
}

TEST(WallResolution, APlateIsThickAsItIsAndTheAdviceScales) {
  const auto walls = coarse_walls(box_mesh({1, 1, 0.02}, 20, 20, 1));
  ASSERT_TRUE(walls);
  EXPECT_NEAR(walls->thickness, 0.02, 1e-12);
  EXPECT_NEAR(walls->edge, 0.05 * std::sqrt(4.0 / 3), 0.002);
  EXPECT_NEAR(walls->wanted_edge, 0.02, 1e-9);
  EXPECT_GT(walls->share, 0.9);
  EXPECT_TRUE(walls->paired);
  const auto small = coarse_walls(box_mesh(1e-3 * Vec3(1, 1, 0.02), 20, 20, 1));
  ASSERT_TRUE(small);
  EXPECT_EQ(small->wanted_triangles, walls->wanted_triangles);
  EXPECT_FALSE(coarse_walls(box_mesh({1, 1, 0.02}, 60, 60, 1)));
}

TEST(WallResolution, AdviceOfCheckFollowsTheThinnestWallThatMatters) {
  const SurfaceReport report = examine(box_mesh({1, 1, 0.02}, 10, 10, 1));
  ASSERT_TRUE(report.advice && report.coarse_walls);
  EXPECT_NEAR(report.advice->crack, 0.01, 1e-12);
  EXPECT_NEAR(examine(box_mesh({1, 1, 1}, 3, 3, 3)).advice->crack, 0.1, 1e-12);
}

/// Plates 1 × 1 × t of n × n squares on either side.
std::optional<CoarseWalls> walls_of_plate(double t, int n) {
  return coarse_walls(box_mesh({1, 1, t}, n, n, 1));
}

TEST(WallResolution, AdviceIsWhatARunWithQuadraticElementsTakes) {
  const auto fair = walls_of_plate(0.02, 10);  // quadratic ones show it as it is
  ASSERT_TRUE(fair);
  EXPECT_TRUE(fair->quadratic_by_themselves());
  EXPECT_FALSE(fair->advised_triangles());
  EXPECT_FALSE(examine(box_mesh({1, 1, 0.02}, 10, 10, 1)).advice->remesh);
  EXPECT_NE(fair->text_of_auto().find("takes quadratic ones by itself"), std::string::npos);
  EXPECT_NE(fair->text().find("run.elements = \"auto\""), std::string::npos) << "of a run of linear elements";

  const auto coarse = walls_of_plate(0.007, 10);  // they do not
  ASSERT_TRUE(coarse);
  ASSERT_TRUE(coarse->advised_triangles());
  EXPECT_LE(*coarse->advised_triangles(), most_quadratic_elements);
  const double edge = std::sqrt(2 / (std::sqrt(3.0) / 4 * static_cast<double>(*coarse->advised_triangles())));
  EXPECT_GE(shown_bending_by_quadratic(edge / 0.007), least_shown);
  EXPECT_NE(coarse->text_of_auto().find(fmt::format("body.remesh = {}", *coarse->advised_triangles())),
            std::string::npos);

  const auto many = walls_of_plate(0.01, 46);  // too many for them
  ASSERT_TRUE(many);
  EXPECT_FALSE(many->quadratic_by_themselves());
  EXPECT_EQ(many->advised_triangles(), least_quadratic_elements);
  EXPECT_EQ(many->text_of_auto(), many->text());

  const auto film = walls_of_plate(0.001, 10);  // out of their reach
  ASSERT_TRUE(film);
  EXPECT_EQ(film->advised_triangles(), most_quadratic_elements);
  EXPECT_NE(film->text_of_auto().find("run.elements = \"quadratic\" and"), std::string::npos);
}

/// A block with a fin on top, as one outline turned about z: a thick disc with a thin brim.
TriMesh brim() {
  return shapes::turned({{0.5, -0.3}, {0.5, -0.04}, {1, -0.04}, {1, 0.04}, {0.5, 0.04}, {0.5, 0.3}}, 48,
                        false);
}

double mean_edge(const TriMesh& mesh, bool thin) {
  double sum = 0, area = 0;
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value) {
    const Vec3 c = centroid(mesh, t);
    const double r = std::hypot(c.x(), c.y());
    if (std::abs(unit_normal(mesh, t).z()) < 0.9 || (thin ? r < 0.6 : r > 0.4)) continue;
    const double a = area_vector(mesh, t).norm();
    sum += a * mean_square_edge(mesh.triangle(t));
    area += a;
  }
  return sum / area;
}

TEST(FollowThickness, ThinWallsGetShortEdgesAndStoutPartsStayCoarse) {
  const TriMesh body = brim();
  ASSERT_NO_THROW(require_valid_body(body, "brim"));
  const int target = 3500;
  const TriMesh mesh = remesh(body, target, {.follow_thickness = true, .limits = {}});
  EXPECT_NO_THROW(require_valid_body(mesh, "remeshed"));
  EXPECT_NEAR(static_cast<double>(mesh.triangle_count()), target, 0.1 * target);
  EXPECT_LT(mean_edge(mesh, true), 1.15 * 0.08);
  EXPECT_GT(mean_edge(mesh, false), 1.5 * mean_edge(mesh, true));
  EXPECT_FALSE(coarse_walls(mesh));
}

TEST(FollowThickness, AdvisedTrianglesSuffice) {
  const TriMesh body = brim();
  const auto before = coarse_walls(remesh(body, 600));
  ASSERT_TRUE(before);
  ASSERT_TRUE(before->affordable());
  const TriMesh mesh =
      remesh(body, static_cast<int>(before->wanted_triangles), {.follow_thickness = true, .limits = {}});
  EXPECT_FALSE(coarse_walls(mesh));
}

TEST(FollowThickness, StoutBodiesComeOutTheSameToTheBit) {
  for (const char* model : {"cube", "cylinder", "bar"}) {
    const TriMesh body = built_in_model(model).mesh;
    const TriMesh plain = remesh(body, 600),
                  followed = remesh(body, 600, {.follow_thickness = true, .limits = {}});
    EXPECT_EQ(plain.positions, followed.positions) << model;
    EXPECT_EQ(plain.corners, followed.corners) << model;
  }
}

TEST(FollowThickness, ALimitOnAPatchSmallerThanTheEdgesAroundIsSeen) {
  const EdgeLimit limit{[](const Vec3& x) { return (x - Vec3(0.03, 0.02, 0.01)).norm() < 0.01; }, 0.005};
  const TriMesh mesh =
      remesh(box_mesh({1, 1, 0.02}, 1, 1, 1), 1500, {.follow_thickness = true, .limits = {limit}});
  int inside = 0;
  for (const auto& corners : mesh.corners)
    inside +=
        std::all_of(corners.begin(), corners.end(), [&](NodeId n) { return limit.holds(mesh.positions[n]); });
  EXPECT_GE(inside, 4);
}

TEST(FollowThickness, LimitsAreKeptWhateverItCostsElsewhere) {
  const TriMesh plate = box_mesh({1, 1, 0.02}, 10, 10, 1);
  const EdgeLimit limit{[](const Vec3& x) { return x.x() < 2.6; }, 0.021};
  TriMesh moved = plate;
  for (Vec3& x : moved.positions)
    x += Vec3(3, 0, 0);  // limits are in the coordinates of the body
  const TriMesh mesh = remesh(moved, 2500, {.follow_thickness = true, .limits = {limit}});
  double sum = 0, count = 0;
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value)
    if (centroid(mesh, t).x() < 2.55 && std::abs(unit_normal(mesh, t).z()) > 0.9) {
      sum += mean_square_edge(mesh.triangle(t));
      ++count;
    }
  ASSERT_GT(count, 100);
  EXPECT_LT(sum / count, 1.15 * 0.021);
  EXPECT_NE(test::refusal([&] {
              remesh(moved, 500, {.follow_thickness = true, .limits = {limit}});
            }).find("region.edge"),
            std::string::npos);
}

}  // namespace
}  // namespace conchoid
