#include "conchoid/mesh/region_rules.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

TEST(SelectRegions, HalfSpaceJustBelowTheTopTakesTheTopFace) {
  const BodyModel cube = built_in_model("cube");
  const auto regions = select_regions(cube.mesh, {{"top", {{Vec3(0, 0, 1), 0.49}}}});
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_EQ(regions[0].name, "top");
  EXPECT_EQ(regions[0].triangles, find_region(cube.regions, "z+")->triangles);
}

TEST(SelectRegions, TheFirstRuleThatFitsWins) {
  const TriMesh cube = box_mesh(Vec3::Ones(), 4, 4, 4);
  const auto regions = select_regions(cube, {{"corner", {{Vec3(0, 0, 1), 0.4}, {Vec3(1, 0, 0), -0.01}}},
                                             {"top", {{Vec3(0, 0, 1), 0.4}}},
                                             {"nothing", {{Vec3(0, 0, 1), 0.5}}},
                                             {"rest", {}}});
  EXPECT_EQ(regions[0].triangles.size(), 16u);
  EXPECT_EQ(regions[1].triangles.size(), 16u);
  EXPECT_TRUE(regions[2].triangles.empty());  // strictly above the top: nothing
  EXPECT_EQ(regions[3].triangles.size(), 192u - 32u);
  const auto region = region_of_triangles(cube, regions);
  for (std::size_t t = 0; t < cube.triangle_count(); ++t)
    EXPECT_EQ(region[TriId(t)] == 3, centroid(cube, TriId(t)).z() < 0.5);
}

TEST(SelectRegions, ATriangleThatReachesOutIsLeftOut) {
  const TriMesh cube = box_mesh(Vec3::Ones(), 4, 4, 4);
  const auto regions = select_regions(cube, {{"upper", {{Vec3(0, 0, 1), 0.1}}}});
  for (TriId t : regions[0].triangles)
    for (const Vec3& x : cube.triangle(t))
      EXPECT_GT(x.z(), 0.1);
  const auto region = region_of_triangles(cube, regions);
  EXPECT_EQ(std::count(region.begin(), region.end(), 0), 32 + 4 * 8);
  EXPECT_EQ(std::count(region.begin(), region.end(), -1), 192 - 64);
}

TEST(SelectRegions, BoxesAndBallsTakeWhatLiesInThem) {
  const TriMesh cube = box_mesh(Vec3::Ones(), 4, 4, 4);
  RegionRule box{.name = "box"}, ball{.name = "ball"};
  box.box = Box{{-0.25, -0.25, 0.5}, {0.25, 0.25, 0.6}};  // its faces belong to it
  ball.ball = RoundBody{{0.5, 0.5, 0.5}, 0.4};
  const auto regions = select_regions(cube, {box, ball});
  EXPECT_EQ(regions[0].triangles.size(), 8u);
  ASSERT_FALSE(regions[1].triangles.empty());
  for (TriId t : regions[1].triangles)
    for (const Vec3& x : cube.triangle(t))
      EXPECT_LE((x - Vec3(0.5, 0.5, 0.5)).norm(), 0.4);
}

TEST(SelectRegions, AnIndenterTakesWhatItTouchesOrNearlyDoes) {
  const TriMesh plate = box_mesh({1, 1, 0.1}, 20, 20, 2);
  RegionRule ball{.name = "ball"}, roll{.name = "roll"};
  ball.indenter = RoundBody{{0, 0, 0.05 + 1}, 1};
  ball.reach = roll.reach = 0.01;  // a cap of radius √(2 R d) = 0.14
  roll.indenter = RoundBody{{0, 0.3, 0.05 + 1}, 1, Vec3(1, 0, 0)};
  const auto regions = select_regions(plate, {ball, roll});
  double widest = 0, along = 0;
  for (TriId t : regions[0].triangles)
    for (const Vec3& x : plate.triangle(t)) {
      EXPECT_NEAR(x.z(), 0.05, 1e-12);
      widest = std::max(widest, x.head<2>().norm());
    }
  EXPECT_GT(widest, 0.1);
  EXPECT_LT(widest, std::sqrt(2 * 0.01) + 0.001);
  for (TriId t : regions[1].triangles)
    for (const Vec3& x : plate.triangle(t)) {
      EXPECT_NEAR(x.y(), 0.3, 0.142);
      along = std::max(along, std::abs(x.x()));
    }
  EXPECT_NEAR(along, 0.5, 1e-12) << "the whole length";
}

TEST(SelectRegions, TheNearestTriangleIsOneAndOfThoseThatFulfilTheRest) {
  const TriMesh cube = box_mesh(Vec3::Ones(), 4, 4, 4);
  RegionRule nearest{.name = "point"}, below{.name = "below"};
  nearest.nearest = below.nearest = Vec3(0.1, 0.2, 3);
  below.half_spaces = {{Vec3(0, 0, -1), 0.49}};
  const auto regions = select_regions(cube, {nearest, below});
  ASSERT_EQ(regions[0].triangles.size(), 1u);
  ASSERT_EQ(regions[1].triangles.size(), 1u);
  EXPECT_NEAR(centroid(cube, regions[0].triangles[0]).z(), 0.5, 1e-12);
  EXPECT_NEAR(centroid(cube, regions[1].triangles[0]).z(), -0.5, 1e-12);
  EXPECT_LT((centroid(cube, regions[0].triangles[0]).head<2>() - Vec2(0.1, 0.2)).norm(), 0.2);
}

TEST(SelectRegions, MaterialsOfTheFileAreRegions) {
  const TriMesh cube = box_mesh(Vec3::Ones(), 1, 1, 1);
  SurfaceAttributes attributes;
  attributes.materials = {"glass", "frame"};
  for (std::size_t t = 0; t < cube.triangle_count(); ++t)
    attributes.material.push_back(t < 4 ? 1 : 0);
  RegionRule rule{.name = "held"};
  rule.material = "frame";
  EXPECT_EQ(select_regions(cube, {rule}, attributes)[0].triangles.size(), 4u);
  EXPECT_TRUE(select_regions(cube, {rule})[0].triangles.empty()) << "a surface without materials";
}

}  // namespace
}  // namespace conchoid
