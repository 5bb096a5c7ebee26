#include "conchoid/core/blas_kernels.hpp"

#include <cstdlib>

extern "C" {
// Weak: null where OpenBLAS does not choose at run time, or is not there.
[[gnu::weak]] void gotoblas_dynamic_init();
[[gnu::weak]] void gotoblas_dynamic_quit();
}

namespace conchoid {
namespace {

bool runs_haswell_kernels() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

// OpenBLAS has chosen when it was loaded, before main(): it forgets that and chooses again.
void use_common_blas_kernels() {
  constexpr const char* variable = "OPENBLAS_CORETYPE";
  if (!gotoblas_dynamic_init || !gotoblas_dynamic_quit || std::getenv(variable) || !runs_haswell_kernels())
    return;
  setenv(variable, "Haswell", 0);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
}

}  // namespace conchoid
