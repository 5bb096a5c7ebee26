#include <gtest/gtest.h>

#include <array>

#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

// Two squares of two triangles each, corner to corner at the origin.
TriMesh hourglass() {
  TriMesh mesh;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0),
                        Vec3(-1, -1, 0), Vec3(0, -1, 0)})
    mesh.positions.push_back(x);
  for (const auto& c : {std::array{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 6}})
    mesh.corners.push_back({NodeId(c[0]), NodeId(c[1]), NodeId(c[2])});
  return mesh;
}

TEST(SplitParts, AreTheMeshesThatWereJoined) {
  const std::vector<TriMesh> parts{hourglass(), disc_crack(Vec3(5, 0, 0), Vec3::UnitZ(), 1, {.edge = 0.3})};
  const std::vector<TriMesh> split = split_parts(join(parts));
  ASSERT_EQ(split.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(split[i].positions, parts[i].positions);
    EXPECT_EQ(split[i].corners, parts[i].corners);
  }
  EXPECT_TRUE(split_parts({}).empty());
}

TEST(SplitFans, PartsThatTouchAtAPointGetBoundariesOfTheirOwn) {
  const TriMesh split = split_fans(hourglass(), 0.1);
  ASSERT_EQ(split.node_count(), 8u);
  EXPECT_EQ(boundary_loops(split).size(), 2u);
  EXPECT_EQ(connected_parts(split).back(), 1);
  EXPECT_NEAR((split.positions[NodeId(0)] - split.positions[NodeId(7)]).norm(), 0.2, 1e-12);
  EXPECT_GT(split.positions[NodeId(0)].x(), 0);  // towards their own side
  EXPECT_LT(split.positions[NodeId(7)].x(), 0);
}

TEST(SplitFans, AProperSheetStaysAsItIs) {
  const TriMesh disc = disc_crack(Vec3::Zero(), Vec3::UnitZ(), 1, {.edge = 0.3});
  const TriMesh split = split_fans(disc, 0.1);
  EXPECT_EQ(split.positions, disc.positions);
  EXPECT_EQ(split.corners, disc.corners);
  EXPECT_TRUE(split_fans({}, 0.1).corners.empty());
}

}  // namespace
}  // namespace conchoid
