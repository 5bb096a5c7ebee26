#include "conchoid/mesh/sort_by_edge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace conchoid {

TEST(SortByEdge, IsTheStableSort) {
  std::mt19937 random(5);
  for (const int nodes : {2, 7, 100}) {
    std::vector<std::pair<Edge, int>> items;
    for (int i = 0; i < 2000; ++i) {
      const auto node = [&] {
        return NodeId(static_cast<std::int32_t>(random() % static_cast<unsigned>(nodes)));
      };
      items.emplace_back(Edge(node(), node()), i);
    }
    auto expected = items;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    sort_by_edge(items, static_cast<std::size_t>(nodes), [](const auto& item) { return item.first; });
    EXPECT_EQ(items, expected);
  }
}

TEST(SortByEdge, NothingIsSorted) {
  std::vector<Edge> none;
  sort_by_edge(none, 0, [](const Edge& e) { return e; });
  EXPECT_TRUE(none.empty());
}

}  // namespace conchoid
