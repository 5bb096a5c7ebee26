#include "conchoid/crack/front/front.hpp"

#include <gtest/gtest.h>

#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

void expect_right_handed(const Front& front) {
  for (const FrontFrame& f : front.frames) {
    EXPECT_NEAR(f.e1.norm(), 1, 1e-14);
    EXPECT_NEAR(f.e2.norm(), 1, 1e-14);
    EXPECT_NEAR(f.e1.dot(f.e2), 0, 1e-14);
    EXPECT_LT((cross(f.e1, f.e2) - f.e3).norm(), 1e-14);
  }
}

}  // namespace

TEST(Fronts, ADiscHasOneRingWhoseForwardIsRadial) {
  const TriMesh mesh = disc(2, 5);
  const auto fronts = find_fronts(mesh, {});
  ASSERT_EQ(fronts.size(), 1u);
  const Front& front = fronts[0];
  EXPECT_TRUE(front.closed);
  ASSERT_EQ(front.nodes.size(), 30u);
  expect_right_handed(front);
  for (std::size_t i = 0; i < front.nodes.size(); ++i) {
    const Vec3& x = mesh.positions[front.nodes[i]];
    EXPECT_LT((front.frames[i].e1 - Vec3::UnitZ()).norm(), 1e-14);
    EXPECT_LT((front.frames[i].e2 - x / 2).norm(), 1e-12);
    const Vec3 step = mesh.positions[front.nodes[(i + 1) % 30]] - x;
    EXPECT_GT(step.dot(front.frames[i].e3), 0);  // nodes in order along e3
  }
}

TEST(Fronts, TangentsOfUnequallySpacedNodesOnACircleAreExactEnough) {
  TriMesh mesh = disc(1, 8);
  for (int j = 0; j < 48; ++j) {  // outer nodes shifted along the circle
    Vec3& x = mesh.positions[NodeId(1 + 3 * 8 * 7 + j)];
    const double phi = std::atan2(x.y(), x.x()) + (j % 3 == 0 ? 0.03 : 0);
    x = {std::cos(phi), std::sin(phi), 0};
  }
  const auto fronts = find_fronts(mesh, {});
  for (std::size_t i = 0; i < 48; ++i)
    EXPECT_LT((fronts[0].frames[i].e2 - mesh.positions[fronts[0].nodes[i]]).norm(), 1e-3);
}

TEST(Fronts, MouthEdgesAreLeftOutAndTheFrontIsOpen) {
  const TriMesh mesh = rectangle(4, 1, 4, 2);
  std::vector<Edge> mouth;
  for (int i = 0; i < 4; ++i)
    mouth.emplace_back(NodeId(i), NodeId(i + 1));
  const auto fronts = find_fronts(mesh, mouth);
  ASSERT_EQ(fronts.size(), 1u);
  const Front& front = fronts[0];
  EXPECT_FALSE(front.closed);
  ASSERT_EQ(front.nodes.size(), 4u + 2 + 2 + 1);
  EXPECT_EQ(front.nodes.front(), NodeId(4));  // counter-clockwise from (4,0) round to (0,0)
  EXPECT_EQ(front.nodes.back(), NodeId(0));
  expect_right_handed(front);
  EXPECT_LT((front.frames.front().e2 - Vec3::UnitX()).norm(), 1e-14);
  EXPECT_LT((front.frames.back().e2 + Vec3::UnitX()).norm(), 1e-14);
}

TEST(Fronts, CornersPointOutAlongTheBisector) {
  const TriMesh mesh = rectangle(3, 3, 3, 3);
  const auto fronts = find_fronts(mesh, {});
  ASSERT_EQ(fronts[0].nodes.size(), 12u);
  EXPECT_EQ(fronts[0].nodes[0], NodeId(0));
  EXPECT_LT((fronts[0].frames[0].e2 + Vec3(1, 1, 0).normalized()).norm(), 1e-14);
}

TEST(Fronts, AnAnnulusHasTwoRingsTheInnerOnePointingIn) {
  TriMesh mesh = disc(3, 3);
  mesh.corners.erase(mesh.corners.begin(), mesh.corners.begin() + 6);
  const auto fronts = find_fronts(mesh, {});
  ASSERT_EQ(fronts.size(), 2u);
  EXPECT_EQ(fronts[0].nodes.size(), 6u);
  EXPECT_EQ(fronts[1].nodes.size(), 18u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((fronts[0].frames[i].e2 + mesh.positions[fronts[0].nodes[i]]).norm(), 1e-12);
}

TEST(Fronts, WhereTwoPartsTouchInANodeTheWalkStaysWithItsTriangles) {
  // A corner cell and the middle cell are missing: the hole touches the outside in node 5, where two separate
  // fans of triangles meet. The boundary turns from one into the other: one curve that passes node 5 twice.
  TriMesh mesh = rectangle(3, 3, 3, 3);
  mesh.corners.erase(mesh.corners.begin() + 8, mesh.corners.begin() + 10);
  mesh.corners.erase(mesh.corners.begin(), mesh.corners.begin() + 2);
  const auto fronts = find_fronts(mesh, {});
  ASSERT_EQ(fronts.size(), 1u);
  const auto& nodes = fronts[0].nodes;
  EXPECT_EQ(nodes.size(), 16u);
  EXPECT_EQ(std::count(nodes.begin(), nodes.end(), NodeId(5)), 2);
}
