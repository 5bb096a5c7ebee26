#include "conchoid/core/parallel.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "conchoid/core/context.hpp"
#include "conchoid/core/interrupt.hpp"

namespace conchoid {
namespace {

#ifdef __SANITIZE_THREAD__
/// TBB synchronises where the thread sanitizer cannot look: under it, threads of our own run the chunks.
void run_chunks(std::size_t chunks, const std::function<void(std::size_t)>& chunk) {
  const ExecutionContext* context = ExecutionContext::current();
  const unsigned threads =
      context ? static_cast<unsigned>(context->threads()) : std::thread::hardware_concurrency();
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(std::max(1u, threads));
  const auto work = [&](std::size_t worker) {
    try {
      for (std::size_t c; (c = next++) < chunks;)
        chunk(c);
    } catch (...) {
      failures[worker] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t worker = 1; worker < failures.size(); ++worker)
      others.emplace_back(work, worker);
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}
#else
void run_chunks(std::size_t chunks, const std::function<void(std::size_t)>& chunk) {
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) { chunk(c); });
}
#endif

}  // namespace

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  grain = std::max<std::size_t>(1, grain);
  const std::size_t chunks = (n + grain - 1) / grain;
  throw_if_interrupted();
  if (chunks == 1) return body(0, n);
  const ExecutionContext* context = ExecutionContext::current();
  run_chunks(chunks, [&](std::size_t c) {
    const CurrentContext inherited(context);
    throw_if_interrupted();
    body(c * grain, std::min(n, (c + 1) * grain));
  });
}

}  // namespace conchoid
