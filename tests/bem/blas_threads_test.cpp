#include "conchoid/core/blas_threads.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "conchoid/core/context.hpp"

extern "C" {
void openblas_set_num_threads(int);
int openblas_get_num_threads();
}

using namespace conchoid;

namespace {

/// A program that lets OpenBLAS use two threads.
class BlasThreads : public testing::Test {
 protected:
  void SetUp() override { openblas_set_num_threads(2); }
  void TearDown() override { openblas_set_num_threads(1); }
};

}  // namespace

TEST_F(BlasThreads, AreOneInsideAContextAndWhatTheyWereAfter) {
  EXPECT_EQ(ExecutionContext().run(openblas_get_num_threads), 1);
  EXPECT_EQ(openblas_get_num_threads(), 2);
}

TEST_F(BlasThreads, AreRestoredByTheLastHolder) {
  auto first = std::make_unique<OneBlasThread>(), second = std::make_unique<OneBlasThread>();
  first.reset();
  EXPECT_EQ(openblas_get_num_threads(), 1);
  second.reset();
  EXPECT_EQ(openblas_get_num_threads(), 2);
}

TEST_F(BlasThreads, AreRestoredAfterAnException) {
  EXPECT_THROW(ExecutionContext(1).run([] { throw 7; }), int);
  EXPECT_EQ(openblas_get_num_threads(), 2);
}
