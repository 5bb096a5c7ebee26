#include "expect_accurate.hpp"

namespace conchoid {
namespace {

TEST(CommonEdge, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(oracle::common_edge_pairs());
}

}  // namespace
}  // namespace conchoid
