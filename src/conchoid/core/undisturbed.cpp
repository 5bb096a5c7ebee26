#include "conchoid/core/undisturbed.hpp"

#include <memory>

#include "conchoid/core/context.hpp"

namespace conchoid {

void undisturbed(const std::function<void()>& work) {
  const ExecutionContext* outer = ExecutionContext::current();
  if (outer == nullptr) return work();
  const std::shared_ptr<MessageSink> sink(std::shared_ptr<void>(), outer->sink());  // owned by the outer one
  ExecutionContext(outer->threads(), sink).run(work);
}

}  // namespace conchoid
