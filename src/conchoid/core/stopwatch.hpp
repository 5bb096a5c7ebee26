#pragma once

#include <chrono>

namespace conchoid {

/// Wall-clock time since it was made, or since the last lap [s].
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// seconds(), and begins anew.
  double lap() {
    const double passed = seconds();
    begin_ = Clock::now();
    return passed;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace conchoid
