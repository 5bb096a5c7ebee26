#include "conchoid/core/blas_kernels.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

extern "C" {
char* openblas_get_corename();
[[gnu::weak]] void gotoblas_dynamic_init();
}

using namespace conchoid;

namespace {

constexpr const char* kVariable = "OPENBLAS_CORETYPE";

bool has_choice() {
#if defined(__x86_64__)
  return gotoblas_dynamic_init != nullptr && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

TEST(BlasKernels, AreThoseForHaswellOnEveryProcessorThatRunsThem) {
  if (!has_choice()) GTEST_SKIP() << "this processor or this OpenBLAS has its own";
  unsetenv(kVariable);
  use_common_blas_kernels();
  EXPECT_EQ(openblas_get_corename(), std::string("Haswell"));
  EXPECT_EQ(std::getenv(kVariable), std::string("Haswell")) << "programs that it starts take the same";
}

TEST(BlasKernels, AreThoseThatTheUserNames) {
  if (!has_choice()) GTEST_SKIP() << "this processor or this OpenBLAS has its own";
  const std::string before = openblas_get_corename();
  setenv(kVariable, "Nehalem", 1);
  use_common_blas_kernels();
  EXPECT_EQ(openblas_get_corename(), before) << "as OpenBLAS took it when it was loaded";
  EXPECT_EQ(std::getenv(kVariable), std::string("Nehalem"));
}
