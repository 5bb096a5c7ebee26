#include "conchoid/core/terminal_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>
#include <string>

namespace conchoid::terminal {
namespace {

constexpr const char* kEraseLine = "\r\033[K";
std::mutex mutex;
std::string shown;

std::size_t width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return 79;
  return size.ws_col - 1u;
}

void write(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

bool interactive() {
  static const bool yes = ::isatty(STDERR_FILENO) != 0;
  return yes;
}

void show(std::string_view text) {
  const std::lock_guard lock(mutex);
  shown = std::string(text.substr(0, width()));
  write(kEraseLine + shown);
}

void clear() {
  const std::lock_guard lock(mutex);
  if (shown.empty()) return;
  shown.clear();
  write(kEraseLine);
}

void print(std::string_view text) {
  const std::lock_guard lock(mutex);
  const std::string line = std::string(text) + "\n";
  write(shown.empty() ? line : kEraseLine + line + shown);
}

}  // namespace conchoid::terminal
