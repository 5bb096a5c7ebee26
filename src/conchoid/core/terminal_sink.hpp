#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

#include "conchoid/core/message_sink.hpp"

namespace conchoid {

/// Messages and warnings as lines of a stream. On a terminal the progress of a loop stands below them, as one
/// line that is written anew and goes with the loop: "runs  120/300  40 %  about 2 min left".
class TerminalSink : public MessageSink {
 public:
  /// @param quiet   warnings only
  /// @param stream  stays open as long as this object exists
  explicit TerminalSink(bool quiet = false, std::FILE* stream = stderr);

  void message(std::string_view text) override;
  void warning(std::string_view text) override;
  void progress_advance(const ProgressReport& report) override;
  void progress_end(const ProgressReport& report) noexcept override;

 private:
  using Clock = std::chrono::steady_clock;
  void print(std::string_view text);
  void write(const std::string& text);
  std::size_t width() const;

  const bool quiet_;
  std::FILE* const stream_;
  const bool interactive_;  ///< a terminal that a person looks at
  std::mutex mutex_;
  std::string shown_;  ///< the line of progress, cut to the terminal's width
  Clock::time_point shown_at_{};
};

/// The line that a TerminalSink shows; the time left is estimated from what is done.
std::string progress_line(const ProgressReport& report);

}  // namespace conchoid
