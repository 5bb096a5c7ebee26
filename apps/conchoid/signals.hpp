#pragma once

#include "conchoid/core/context.hpp"

namespace conchoid {

/// Ctrl-C (SIGINT) or SIGTERM asks `context` to stop while this object exists; a second one ends the program
/// at once. One object at a time.
class StopOnSignals {
 public:
  explicit StopOnSignals(ExecutionContext& context);
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;
};

}  // namespace conchoid
