#include "conchoid/core/log.hpp"

#include "conchoid/core/context.hpp"

namespace conchoid {
namespace {

MessageSink* current_sink() {
  const ExecutionContext* context = ExecutionContext::current();
  return context ? context->sink() : nullptr;
}

}  // namespace

void message(std::string_view text) {
  if (MessageSink* sink = current_sink()) sink->message(text);
}

void warning(std::string_view text) {
  if (MessageSink* sink = current_sink()) sink->warning(text);
}

}  // namespace conchoid
