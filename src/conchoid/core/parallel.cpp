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

/// What is written before a loop is seen by its bodies, and what they write after it. The loop itself sees to
/// that, in a library that the thread sanitizer cannot look into: there it is said once more.
class Handover {
 public:
#ifdef __SANITIZE_THREAD__
  Handover() {
    state_.store(1, std::memory_order_release);
  }
  void begin() const {
    state_.load(std::memory_order_acquire);
  }
  void end() {
    state_.fetch_add(1, std::memory_order_acq_rel);
  }
  void finish() const {
    begin();
  }

 private:
  std::atomic<std::size_t> state_{0};
#else
  void begin() const {}
  void end() {}
  void finish() const {}
#endif
};
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
  Handover data;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    data.begin();
    body(c * grain, std::min(n, (c + 1) * grain));
    data.end();
  });
  data.finish();
}

}  // namespace conchoid
