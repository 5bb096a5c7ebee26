#include "expect_accurate.hpp"

namespace conchoid {
namespace {

TEST(CommonVertex, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(oracle::common_vertex_pairs());
}

}  // namespace
}  // namespace conchoid
