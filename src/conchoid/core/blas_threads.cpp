#include "conchoid/core/blas_threads.hpp"

#include <mutex>

extern "C" {
// Weak: null in programs that are linked with another BLAS, or with none.
[[gnu::weak]] void openblas_set_num_threads(int);
[[gnu::weak]] int openblas_get_num_threads();
}

namespace conchoid {
namespace {

std::mutex mutex;
int holders = 0, threads_before = 0;

bool has_openblas() {
  return openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr;
}

}  // namespace

OneBlasThread::OneBlasThread() {
  if (!has_openblas()) return;
  const std::lock_guard lock(mutex);
  if (holders++ > 0) return;
  threads_before = openblas_get_num_threads();
  if (threads_before != 1) openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (!has_openblas()) return;
  const std::lock_guard lock(mutex);
  if (--holders == 0 && threads_before != 1) openblas_set_num_threads(threads_before);
}

}  // namespace conchoid
