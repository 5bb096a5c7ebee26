#include "conchoid/core/background_queue.hpp"

#include <utility>

#include "conchoid/core/context.hpp"

namespace conchoid {

BackgroundQueue::BackgroundQueue(std::size_t most) : most_(most) {}

BackgroundQueue::~BackgroundQueue() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void BackgroundQueue::throw_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

void BackgroundQueue::add(std::function<void()> job) {
  if (const ExecutionContext* context = ExecutionContext::current(); context && context->threads() == 1)
    return job();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_.size() < most_; });
  throw_failure();
  waiting_.push_back(std::move(job));
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  changed_.notify_all();
}

void BackgroundQueue::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty(); });
  throw_failure();
}

void BackgroundQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::function<void()>& job = waiting_.front();  // stays where it is while others are added
    std::exception_ptr failure;
    lock.unlock();
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    waiting_.pop_front();
    if (failure) {
      failure_ = failure;
      waiting_.clear();
    }
    changed_.notify_all();
  }
}

}  // namespace conchoid
