#pragma once

#include <cstddef>
#include <string_view>

namespace conchoid {

/// How far a long loop is.
struct ProgressReport {
  std::string_view label;           ///< what is counted: "runs", "trees"
  std::size_t done = 0, total = 0;  ///< steps
  double seconds = 0;               ///< since the loop started
};

/// Receives what the library has to say while it works; the library itself writes to no stream. A program
/// derives from it and hands it to an ExecutionContext. Calls come from worker threads, several at a time. An
/// exception leaves through the call that reported, so a sink may stop a loop; progress_end() must not throw.
class MessageSink {
 public:
  virtual ~MessageSink() = default;

  /// One line about what is being done.
  virtual void message(std::string_view text) = 0;
  /// The result may not be what the user expects, and what to do about it. No "warning:" in front.
  virtual void warning(std::string_view text) = 0;
  /// A loop starts, did some steps, is over or was left early. Loops may run side by side and inside others.
  virtual void progress_begin(const ProgressReport&) {}
  virtual void progress_advance(const ProgressReport&) {}
  virtual void progress_end(const ProgressReport&) noexcept {}
};

}  // namespace conchoid
