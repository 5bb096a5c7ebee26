#include "conchoid/mesh/closest_point.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "mesh/mesh_checks.hpp"

using namespace conchoid;

TEST(ClosestPoint, FaceEdgeAndCornerOfATriangle) {
  const Triangle t{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  EXPECT_EQ(closest_point_on_triangle(t, {0.5, 0.5, 3}), Vec3(0.5, 0.5, 0));
  EXPECT_EQ(closest_point_on_triangle(t, {1, -2, 1}), Vec3(1, 0, 0));
  EXPECT_EQ(closest_point_on_triangle(t, {2, 2, 5}), Vec3(1, 1, 0));
  EXPECT_EQ(closest_point_on_triangle(t, {-1, -1, 0}), Vec3(0, 0, 0));
  EXPECT_EQ(closest_point_on_triangle(t, {5, -1, 0}), Vec3(2, 0, 0));
  const Triangle needle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  EXPECT_EQ(closest_point_on_triangle(needle, {1.5, 1, 0}), Vec3(1.5, 0, 0));
}

TEST(ClosestPoint, TreeAgreesWithLookingAtEveryTriangle) {
  const TriMesh mesh = random_soup(300, 1);
  const ClosestPointTree tree(mesh);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    TriId best;
    double best2 = 1e300;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const double d2 = (closest_point_on_triangle(mesh.triangle(TriId(t)), x) - x).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best = TriId(t);
      }
    }
    const auto hit = tree.closest(x);
    EXPECT_EQ(hit.triangle, best);
    EXPECT_EQ(hit.squared_distance, best2);
    const ClosestHit alone = closest_point(mesh, x);
    EXPECT_EQ(alone.triangle, best);
    EXPECT_EQ(alone.point, hit.point);
    EXPECT_EQ(alone.squared_distance, best2);
  }
}

TEST(ClosestPoint, NothingIsInfinitelyFarAway) {
  const auto hit = ClosestPointTree(TriMesh{}).closest(Vec3::Zero());
  EXPECT_FALSE(hit.triangle.valid());
  EXPECT_EQ(hit.squared_distance, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(closest_point(TriMesh{}, Vec3::Zero()).triangle.valid());
}
