#include "expect_accurate.hpp"

namespace conchoid {
namespace {

TEST(Far, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(oracle::far_pairs());
}

}  // namespace
}  // namespace conchoid
