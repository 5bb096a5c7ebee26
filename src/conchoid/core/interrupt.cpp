#include "conchoid/core/interrupt.hpp"

#include <atomic>
#include <csignal>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

void remember(int signal) {
  signalled = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

bool interrupted() {
  return signalled;
}

void throw_if_interrupted() {
  if (interrupted()) throw Interrupted("stopped on request; what was finished has been kept");
}

}  // namespace conchoid
