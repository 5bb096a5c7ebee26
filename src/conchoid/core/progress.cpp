#include "conchoid/core/progress.hpp"

#include <algorithm>

#include "conchoid/core/context.hpp"

namespace conchoid {

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)),
      total_(total),
      sink_(ExecutionContext::current() ? ExecutionContext::current()->sink() : nullptr) {
  if (sink_) sink_->progress_begin(report());
}

Progress::~Progress() {
  if (sink_) sink_->progress_end(report());
}

void Progress::advance(std::size_t steps) {
  const std::lock_guard lock(mutex_);
  done_ = std::min(total_, done_ + steps);
  if (sink_) sink_->progress_advance(report());
}

ProgressReport Progress::report() const {
  return {label_, done_, total_, std::chrono::duration<double>(Clock::now() - start_).count()};
}

}  // namespace conchoid
