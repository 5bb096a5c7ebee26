#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "conchoid/core/message_sink.hpp"

namespace conchoid {

/// A long loop that tells the sink of the current context how far it is, until destroyed. advance() may be
/// called from any thread.
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t steps = 1);
  std::size_t done() const { return done_; }

 private:
  using Clock = std::chrono::steady_clock;
  ProgressReport report() const;

  std::string label_;
  std::size_t total_, done_ = 0;
  Clock::time_point start_ = Clock::now();
  MessageSink* sink_;
  std::mutex mutex_;
};

}  // namespace conchoid
