#include "conchoid/core/union_find.hpp"

#include <gtest/gtest.h>

using conchoid::UnionFind;

TEST(UnionFind, SetsAreNamedByTheirFirstMember) {
  UnionFind sets(6);
  sets.join(5, 2);
  sets.join(4, 5);
  sets.join(1, 3);
  EXPECT_EQ(sets.root(4), 2u);
  EXPECT_EQ(sets.root(3), 1u);
  EXPECT_EQ(sets.root(0), 0u);
  sets.join(4, 3);
  for (const std::size_t i : {1, 2, 3, 4, 5})
    EXPECT_EQ(sets.root(i), 1u) << i;
  sets.join(2, 4);  // already one
  EXPECT_EQ(sets.root(5), 1u);
}
