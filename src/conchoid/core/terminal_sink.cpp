#include "conchoid/core/terminal_sink.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace conchoid {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string progress_line(const ProgressReport& r) {
  std::string line = fmt::format("{}  {}/{}", r.label, r.done, r.total);
  if (r.total == 0) return line;
  line += fmt::format("  {} %", 100 * r.done / r.total);
  if (r.done == 0 || r.done >= r.total) return line;
  const double left = r.seconds * static_cast<double>(r.total - r.done) / static_cast<double>(r.done);
  return line + fmt::format("  about {} left", duration(left));
}

TerminalSink::TerminalSink(bool quiet, std::FILE* stream)
    : quiet_(quiet), stream_(stream), interactive_(::isatty(::fileno(stream)) != 0) {}

void TerminalSink::message(std::string_view text) {
  if (!quiet_) print(text);
}

void TerminalSink::warning(std::string_view text) {
  print("warning: " + std::string(text));
}

void TerminalSink::progress_advance(const ProgressReport& report) {
  if (quiet_ || !interactive_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - shown_at_ < std::chrono::milliseconds(100)) return;
  shown_at_ = now;
  shown_ = progress_line(report).substr(0, width());
  write(kEraseLine + shown_);
}

void TerminalSink::progress_end(const ProgressReport&) noexcept {
  const std::lock_guard lock(mutex_);
  if (shown_.empty()) return;
  shown_.clear();
  write(kEraseLine);
}

/// A lasting line; that of the progress reappears below it.
void TerminalSink::print(std::string_view text) {
  const std::lock_guard lock(mutex_);
  const std::string line = std::string(text) + "\n";
  write(shown_.empty() ? line : kEraseLine + line + shown_);
}

void TerminalSink::write(const std::string& text) {
  std::fputs(text.c_str(), stream_);
  std::fflush(stream_);
}

std::size_t TerminalSink::width() const {
  winsize size{};
  if (::ioctl(::fileno(stream_), TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return 79;
  return size.ws_col - 1u;
}

}  // namespace conchoid
