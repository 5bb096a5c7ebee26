#include "conchoid/core/progress.hpp"

#include <gtest/gtest.h>

using namespace conchoid;

TEST(Progress, EstimatesTheTimeLeft) {
  EXPECT_EQ(progress_line("runs", 0, 300, 0), "runs  0/300  0 %");
  EXPECT_EQ(progress_line("runs", 100, 300, 20), "runs  100/300  33 %  about 40 s left");
  EXPECT_EQ(progress_line("runs", 1, 300, 2), "runs  1/300  0 %  about 10 min left");
  EXPECT_EQ(progress_line("runs", 300, 300, 60), "runs  300/300  100 %");
}

TEST(Progress, NeverPassesItsTotal) {
  Progress progress("runs", 3);
  progress.advance(2);
  progress.advance(2);
  EXPECT_EQ(progress.done(), 3u);
}
