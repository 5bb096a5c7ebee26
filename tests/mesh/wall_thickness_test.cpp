#include "conchoid/mesh/wall_thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/mesh/bores.hpp"
#include "conchoid/mesh/models.hpp"
#include "hollow_bodies.hpp"

namespace conchoid {
namespace {

double thickness_below(const TriMesh& mesh, const Vec3& x, const Vec3& normal, double reach) {
  const double thickness = WallProbe(mesh).thickness(x, normal, reach);
  EXPECT_EQ(wall_thickness(mesh, x, normal, reach), thickness);
  return thickness;
}

TEST(WallThickness, IsThatOfABoxFromAllItsSides) {
  const TriMesh box = box_mesh({1, 0.5, 0.1}, 7, 5, 2);
  EXPECT_NEAR(thickness_below(box, {0.1, 0.1, 0.05}, Vec3::UnitZ(), 2), 0.1, 1e-14);
  EXPECT_NEAR(thickness_below(box, {0.1, 0.1, -0.05}, -Vec3::UnitZ(), 2), 0.1, 1e-14);
  EXPECT_TRUE(std::isinf(thickness_below(box, {0.1, 0.1, 0.05}, Vec3::UnitZ(), 0.09)));
  // Most rays from the narrow side meet the broad ones askew, which are no walls of it.
  EXPECT_TRUE(std::isinf(thickness_below(box, {0.5, 0.1, 0.01}, Vec3::UnitX(), 2)));
}

TEST(WallThickness, ScalesAndDoesNotDependOnTheTriangles) {
  for (const int n : {1, 3, 10}) {
    const TriMesh box = box_mesh(1e-6 * Vec3(1, 1, 0.01), n, n, 1);
    IdVector<TriId, double> reach(box.triangle_count(), 1e-6);
    const IdVector<TriId, double> thickness = WallProbe(box).thickness(reach);
    for (TriId t(0); t.index() < thickness.size(); ++t.value)
      if (std::abs(unit_normal(box, t).z()) > 0.5) {
        EXPECT_NEAR(thickness[t], 1e-8, 1e-20) << n;
      }
  }
}

TEST(WallThickness, OfABallIsItsDiameter) {
  const TriMesh ball = icosphere(1, 4);
  EXPECT_NEAR(thickness_below(ball, {0, 0, 1}, Vec3::UnitZ(), 10), 2, 0.25);  // tilted rays are shorter
}

TEST(WallThickness, ANeedleInTheWayOfOneRayDoesNotCount) {
  TriMesh body = box_mesh({1, 1, 1}, 3, 3, 3);
  const TriMesh needle = box_mesh({0.02, 0.02, 0.02}, 1, 1, 1);  // a cavity straight below the point
  const std::size_t before = body.node_count();
  for (const Vec3& x : needle.positions)
    body.positions.push_back(x + Vec3(0.1, 0.1, 0.3));
  for (const auto& c : needle.corners)
    body.corners.push_back(
        {NodeId(c[0].index() + before), NodeId(c[2].index() + before), NodeId(c[1].index() + before)});
  EXPECT_NEAR(thickness_below(body, {0.1, 0.1, 0.5}, Vec3::UnitZ(), 3), 1, 1e-12);
}

TEST(Bores, AreHolesAndCavitiesAndNothingElse) {
  const TriMesh tube = shapes::turned({{0.1, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {0.1, 0.2}}, 24, true);
  const auto found = bores(tube);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].radius, 0.1, 0.002);
  EXPECT_LT(found[0].center.norm(), 1e-12);
  for (const char* model : {"cube", "cylinder", "bar", "edge-crack-cube"})
    EXPECT_TRUE(bores(built_in_model(model).mesh).empty()) << model;
  EXPECT_TRUE(bores(icosphere(1, 2)).empty());
}

}  // namespace
}  // namespace conchoid
