#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace conchoid {

/// Jobs that a thread of its own carries out in their order, beside what the caller goes on with: files to be written. Jobs run
/// outside of any ExecutionContext. Where the current context has one thread, so that nothing may run beside anything, a job is
/// carried out where it is added.
class BackgroundQueue {
 public:
  /// @param most  jobs that may wait at a time, ≥ 1: what they hold is kept in memory so long
  explicit BackgroundQueue(std::size_t most = 4);
  /// Carries out what was added; failures stay unheard.
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// Returns at once, or when fewer than `most` jobs wait. Throws what an earlier job has thrown; after that no job is carried
  /// out any more.
  void add(std::function<void()> job);
  /// Returns when everything is done. Throws as add() does.
  void finish();

 private:
  void work();
  void throw_failure() const;

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;  // the first one is being carried out
  std::exception_ptr failure_;
  bool ended_ = false;
  std::thread thread_;  // started by the first job
};

}  // namespace conchoid
