#include "expect_accurate.hpp"

namespace conchoid {
namespace {

TEST(Near, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(oracle::near_pairs());
}

}  // namespace
}  // namespace conchoid
