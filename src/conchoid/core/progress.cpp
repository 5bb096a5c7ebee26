#include "conchoid/core/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "conchoid/core/log.hpp"
#include "conchoid/core/terminal_line.hpp"

namespace conchoid {
namespace {

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string progress_line(const std::string& label, std::size_t done, std::size_t total, double seconds) {
  std::string line = fmt::format("{}  {}/{}", label, done, total);
  if (total == 0) return line;
  line += fmt::format("  {} %", 100 * done / total);
  if (done == 0 || done >= total) return line;
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return line + fmt::format("  about {} left", duration(left));
}

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), total_(total), visible_(terminal::interactive() && !quiet()) {}

Progress::~Progress() {
  if (visible_) terminal::clear();
}

void Progress::advance(std::size_t steps) {
  const std::lock_guard lock(mutex_);
  done_ = std::min(total_, done_ + steps);
  const Clock::time_point now = Clock::now();
  if (!visible_ || now - shown_ < std::chrono::milliseconds(100)) return;
  shown_ = now;
  terminal::show(progress_line(label_, done_, total_, std::chrono::duration<double>(now - start_).count()));
}

}  // namespace conchoid
