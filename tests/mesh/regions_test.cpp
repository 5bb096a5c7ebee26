#include "conchoid/mesh/regions.hpp"

#include <algorithm>

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

}  // namespace
}  // namespace conchoid
