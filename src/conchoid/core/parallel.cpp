#include "conchoid/core/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

namespace conchoid {
namespace {
std::unique_ptr<tbb::global_control> control;
int threads_wanted = 0;

#ifdef __SANITIZE_THREAD__
/// What is written before a loop is seen by its bodies, and what they write after it. TBB sees to that, where
/// the thread sanitizer cannot look: here it is said once more.
std::atomic<std::size_t> handed_over{0};
void hand_over() {
  handed_over.fetch_add(1, std::memory_order_acq_rel);
}
#else
void hand_over() {}
#endif
}  // namespace

void set_thread_count(int threads) {
  threads_wanted = threads;
  control.reset();
  if (threads > 0)
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
}

int thread_count() {
  return threads_wanted > 0 ? threads_wanted
                            : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  grain = std::max<std::size_t>(1, grain);
  const std::size_t chunks = (n + grain - 1) / grain;
  if (chunks == 1) return body(0, n);
  hand_over();
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    hand_over();
    body(c * grain, std::min(n, (c + 1) * grain));
    hand_over();
  });
  hand_over();
}

}  // namespace conchoid
