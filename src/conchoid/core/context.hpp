#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "conchoid/core/message_sink.hpp"

namespace conchoid {

/// How many threads work, who hears messages, and a way to stop: for all that runs inside run(), parallel
/// loops included, and for nothing else of the program. Nothing of it changes a result.
///
///     ExecutionContext context(2, std::make_shared<TerminalSink>());
///     const RunResult result = context.run([&] { return run_scene(scene, {}); });
///
/// Outside of run() the library works, too: on the threads that TBB gives the caller, without messages, with
/// the same bits. OpenBLAS works on one thread inside run() and inside every function of the library that
/// calls it (core/blas_threads.hpp); what the program had set is restored after.
class ExecutionContext {
 public:
  /// @param threads  at most so many work, the calling one included; 0: as many as the machine has
  /// @param sink     hears messages, warnings and progress; none: nobody does
  explicit ExecutionContext(int threads = 0, std::shared_ptr<MessageSink> sink = nullptr);
  ~ExecutionContext();
  ExecutionContext(const ExecutionContext&) = delete;
  ExecutionContext& operator=(const ExecutionContext&) = delete;

  /// Calls work() in this context and returns its result. Several threads may do so at a time, and contexts
  /// may be nested: the innermost one counts. Exceptions pass through.
  template <class Work>
  std::invoke_result_t<Work> run(Work&& work) const {
    using Result = std::invoke_result_t<Work>;
    if constexpr (std::is_void_v<Result>) {
      execute([&] { work(); });
    } else {
      std::optional<Result> result;
      execute([&] { result.emplace(work()); });
      return std::move(*result);
    }
  }

  /// Threads that may work at a time, ≥ 1.
  int threads() const;
  MessageSink* sink() const { return sink_.get(); }

  /// Long loops end soon after: a run keeps and returns what it has, other work throws Interrupted. From any
  /// thread and from signal handlers. It cannot be taken back.
  void request_stop() noexcept { stop_ = true; }
  bool stop_requested() const noexcept { return stop_; }

  /// The context the calling thread works in; null outside of any.
  static const ExecutionContext* current();

 private:
  struct Arena;
  void execute(const std::function<void()>& work) const;

  std::unique_ptr<Arena> arena_;
  std::shared_ptr<MessageSink> sink_;
  std::atomic<bool> stop_ = false;
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");
};

/// Makes a context the current one of this thread until destroyed. Parallel loops put one around what they
/// run on other threads; whoever starts threads of his own does the same.
class CurrentContext {
 public:
  explicit CurrentContext(const ExecutionContext* context);
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  const ExecutionContext* before_;
};

}  // namespace conchoid
