#include "conchoid/core/interrupt.hpp"

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {

bool interrupted() {
  const ExecutionContext* context = ExecutionContext::current();
  return context != nullptr && context->stop_requested();
}

void throw_if_interrupted() {
  if (interrupted()) throw Interrupted("stopped on request; what was finished has been kept");
}

}  // namespace conchoid
