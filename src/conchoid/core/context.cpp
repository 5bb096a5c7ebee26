#include "conchoid/core/context.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

#include "conchoid/core/blas_threads.hpp"

namespace conchoid {
namespace {

thread_local const ExecutionContext* current_context = nullptr;

}  // namespace

struct ExecutionContext::Arena {
  explicit Arena(int threads) : tasks(threads > 0 ? threads : tbb::task_arena::automatic) {}
  mutable tbb::task_arena tasks;
};

ExecutionContext::ExecutionContext(int threads, std::shared_ptr<MessageSink> sink)
    : arena_(std::make_unique<Arena>(threads)), sink_(std::move(sink)) {}

ExecutionContext::~ExecutionContext() = default;

int ExecutionContext::threads() const {
  return std::max(1, arena_->tasks.max_concurrency());
}

const ExecutionContext* ExecutionContext::current() {
  return current_context;
}

void ExecutionContext::execute(const std::function<void()>& work) const {
  const OneBlasThread one_blas_thread;
  const auto inside = [&] {
    const CurrentContext here(this);  // another thread of the arena may be the one that works
    work();
  };
#ifdef __SANITIZE_THREAD__
  inside();  // core/parallel.cpp starts threads of its own
#else
  arena_->tasks.execute(inside);
#endif
}

CurrentContext::CurrentContext(const ExecutionContext* context) : before_(current_context) {
  current_context = context;
}

CurrentContext::~CurrentContext() {
  current_context = before_;
}

}  // namespace conchoid
