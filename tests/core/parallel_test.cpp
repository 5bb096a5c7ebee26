#include "conchoid/core/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"

using namespace conchoid;

namespace {

void expect_every_index_once() {
  std::vector<int> visits(1003, 0);
  parallel_for(visits.size(), 7, [&](std::size_t begin, std::size_t end) {
    EXPECT_LE(end - begin, 7u);
    for (std::size_t i = begin; i < end; ++i)
      ++visits[i];
  });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 1003);
}

}  // namespace

TEST(Parallel, EveryIndexIsVisitedOnce) {
  expect_every_index_once();
  for (const int threads : {1, 2, 0})
    ExecutionContext(threads).run(expect_every_index_once);
}

TEST(Parallel, AnExceptionOfTheBodyArrives) {
  const auto fail = [] {
    parallel_for(100, 1, [](std::size_t i, std::size_t) {
      if (i == 57) throw ComputationError("57");
    });
  };
  EXPECT_THROW(fail(), ComputationError);
  EXPECT_THROW(ExecutionContext(2).run(fail), ComputationError);
}
