#include "conchoid/mesh/id_lists.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace conchoid;

TEST(NodeLists, KeepTheOrderInWhichValuesCame) {
  const std::vector<std::pair<int, int>> pairs{{2, 7}, {0, 1}, {2, 3}, {2, 7}, {0, 0}};
  const NodeLists<int> lists(4, [&](const auto& put) {
    for (const auto& [node, value] : pairs)
      put(NodeId(node), value);
  });
  const auto list = [&](int node) {
    const auto values = lists[NodeId(node)];
    return std::vector<int>(values.begin(), values.end());
  };
  EXPECT_EQ(list(0), (std::vector<int>{1, 0}));
  EXPECT_TRUE(list(1).empty());
  EXPECT_EQ(list(2), (std::vector<int>{7, 3, 7}));
  EXPECT_TRUE(list(3).empty());
}

TEST(NodeLists, TrianglesAroundNodes) {
  TriMesh mesh;
  for (int i = 0; i < 5; ++i)
    mesh.positions.push_back(Vec3(i, i * i, 0));
  mesh.corners.push_back({NodeId(0), NodeId(1), NodeId(2)});
  mesh.corners.push_back({NodeId(2), NodeId(1), NodeId(3)});
  const NodeLists<TriId> stars = triangles_at_nodes(mesh);
  EXPECT_EQ(stars[NodeId(1)].size(), 2u);
  EXPECT_EQ(stars[NodeId(2)].back(), TriId(1));
  EXPECT_EQ(stars[NodeId(3)].front(), TriId(1));
  EXPECT_TRUE(stars[NodeId(4)].empty());
}
