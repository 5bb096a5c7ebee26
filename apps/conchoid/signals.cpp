#include "signals.hpp"

#include <atomic>
#include <csignal>

namespace conchoid {
namespace {

std::atomic<ExecutionContext*> context_to_stop = nullptr;
static_assert(std::atomic<ExecutionContext*>::is_always_lock_free, "a signal handler reads it");

void stop(int signal) {
  if (ExecutionContext* context = context_to_stop) context->request_stop();
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopOnSignals::StopOnSignals(ExecutionContext& context) {
  context_to_stop = &context;
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
}

StopOnSignals::~StopOnSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  context_to_stop = nullptr;
}

}  // namespace conchoid
