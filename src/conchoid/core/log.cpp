#include "conchoid/core/log.hpp"

#include <atomic>
#include <string>

#include "conchoid/core/terminal_line.hpp"

namespace conchoid {
namespace {
std::atomic<bool> is_quiet = false;
}

void set_quiet(bool quiet) {
  is_quiet = quiet;
}

bool quiet() {
  return is_quiet;
}

void message(std::string_view text) {
  if (!quiet()) terminal::print(text);
}

void warning(std::string_view text) {
  terminal::print("warning: " + std::string(text));
}

}  // namespace conchoid
