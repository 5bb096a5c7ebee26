#include "conchoid/core/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

using namespace conchoid;

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (int threads : {1, 2, 0}) {
    set_thread_count(threads);
    std::vector<int> visits(1003, 0);
    parallel_for(visits.size(), 7, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        ++visits[i];
    });
    EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), 0), 1003);
    for (int v : visits)
      ASSERT_EQ(v, 1);
  }
  set_thread_count(0);
}
