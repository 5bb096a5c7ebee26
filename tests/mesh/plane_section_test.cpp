#include "conchoid/mesh/plane_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "arbitrary_rotation.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/turned_bodies.hpp"

namespace conchoid {
namespace {

TriMesh moved(TriMesh mesh, const Mat3& turn, const Vec3& by) {
  for (Vec3& x : mesh.positions)
    x = turn * x + by;
  return mesh;
}

}  // namespace

TEST(PlaneSection, OfABoxIsARectangleWhereverItLies) {
  const Mat3 turn = test::arbitrary_rotation();
  const Vec3 by(3, -2, 7);
  const TriMesh box = moved(box_mesh({2, 3, 5}, 2, 3, 4), turn, by);
  const Box around = bounding_box(box_mesh({2, 3, 5}, 2, 3, 4));
  const auto at = [&](const Vec3& share) {
    return Vec3(turn * (around.low + share.cwiseProduct(around.high - around.low)) + by);
  };
  EXPECT_NEAR(section_area(box, at({0.5, 0.4, 0.3}), turn.col(2)), 6, 1e-12);
  EXPECT_NEAR(section_area(box, at({0.5, 0.4, 0.5}), -turn.col(2)), 6, 1e-12) << "through its nodes";
  EXPECT_NEAR(section_area(box, at({0.1, 0.4, 0.9}), turn.col(0)), 15, 1e-12);
  EXPECT_NEAR(section_area(box, at({0.5, 0.5, 0.5}), (turn.col(0) + turn.col(1)).normalized()),
              5 * 2 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(section_area(box, at({0.5, 0.5, 1.2}), turn.col(2)), 0);
}

TEST(PlaneSection, LeavesHolesOutAndTakesThePartNextToThePoint) {
  // A ring of square section, radii 1 and 2, height 1.
  const TriMesh ring = turned_body({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 256, OutlineKind::ring);
  const double annulus = 3 * std::numbers::pi;
  EXPECT_NEAR(section_area(ring, {1.5, 0, 0.5}, Vec3::UnitZ()), annulus, 1e-3 * annulus);
  EXPECT_NEAR(section_area(ring, {0, 0, 0.5}, Vec3::UnitZ()), annulus, 1e-3 * annulus);
  // Across it there are two parts.
  EXPECT_NEAR(section_area(ring, {0, 1.5, 0.5}, Vec3::UnitX()), 1, 1e-3);
  EXPECT_NEAR(section_area(ring, {0, -1.5, 0.5}, Vec3::UnitX()), 1, 1e-3);
  EXPECT_NEAR(section_area(ring, {0, 2.5, 0.5}, Vec3::UnitX()), 1, 1e-3) << "from outside";
}

}  // namespace conchoid
