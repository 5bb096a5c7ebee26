#include "conchoid/mesh/place.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace conchoid {

TEST(Place, WelderGivesEveryPlaceOneNode) {
  TriMesh mesh;
  NodeWelder node(mesh);
  const NodeId a = node({0.1, -0.0, 3}), b = node({0.1, std::nextafter(0.0, 1.0), 3});
  EXPECT_EQ(node({0.1, 0.0, 3}), a) << "−0 is 0";
  EXPECT_NE(a, b) << "the last bit counts";
  EXPECT_EQ(mesh.node_count(), 2u);
  EXPECT_FALSE(std::signbit(mesh.positions[a].y()));
}

TEST(Place, FirstOfEqualNodesHasTheLowestId) {
  TriMesh mesh;
  for (const Vec3& x : {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(1, -0.0, 0), Vec3(0, 0, 1e-300), Vec3(1, 0, 0)})
    mesh.positions.push_back(x);
  EXPECT_EQ(first_at_place(mesh),
            (IdVector<NodeId, NodeId>{NodeId(0), NodeId(1), NodeId(0), NodeId(3), NodeId(0)}));
}

}  // namespace conchoid
