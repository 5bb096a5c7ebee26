#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace conchoid {

/// How far a long loop is, as one line on stderr: "cube runs  120/300  40 %  about 2 min left". Shown on a
/// terminal only and not with --quiet; gone when the object is. advance() may be called from any thread.
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
  std::string label_;
  std::size_t total_, done_ = 0;
  Clock::time_point start_ = Clock::now(), shown_{};
  bool visible_;
  std::mutex mutex_;
};

/// The line that Progress shows. @param seconds  since the loop started; the time left is estimated from it
std::string progress_line(const std::string& label, std::size_t done, std::size_t total, double seconds);

}  // namespace conchoid
