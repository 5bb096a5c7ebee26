#include "conchoid/mesh/ray_exit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

TEST(RayExit, FromInsideABoxItIsTheWallAheadWhateverTheDirection) {
  const TriMesh box = box_mesh({2, 1, 0.5}, 4, 3, 2);
  const BoxTree tree(box);
  const Vec3 half(1, 0.5, 0.25), x(0.3, -0.1, 0.05);
  for (const Vec3& towards : {Vec3(1, 0, 0), Vec3(-1, 0.2, 0.1), Vec3(0.3, 1, -0.4), Vec3(0, 0, -1)}) {
    const Vec3 d = towards.normalized();
    double wall = INFINITY;
    for (int k = 0; k < 3; ++k)
      if (d[k] != 0) wall = std::min(wall, (std::copysign(half[k], d[k]) - x[k]) / d[k]);
    EXPECT_NEAR(exit_distance(box, tree, x, d), wall, 1e-12);
  }
}

TEST(RayExit, ThroughAnEdgeBetweenTrianglesItIsNotLost) {
  const TriMesh box = box_mesh({1, 1, 1}, 2, 2, 2);
  EXPECT_NEAR(exit_distance(box, BoxTree(box), Vec3::Zero(), Vec3::UnitX()), 0.5, 1e-12);
}

TEST(RayExit, NothingAheadIsEndless) {
  const TriMesh box = box_mesh({1, 1, 1}, 1, 1, 1);
  EXPECT_EQ(exit_distance(box, BoxTree(box), {2, 0, 0}, Vec3::UnitX()), INFINITY);
  EXPECT_EQ(exit_distance(TriMesh{}, BoxTree(TriMesh{}), Vec3::Zero(), Vec3::UnitX()), INFINITY);
}

}  // namespace
}  // namespace conchoid
