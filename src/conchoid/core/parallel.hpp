#pragma once

#include <cstddef>
#include <functional>

namespace conchoid {

/// Calls body(begin, end) on disjoint ranges that cover [0, n), at most `grain` long, on the threads of the
/// current context (core/context.hpp), which stays the current one inside. The ranges depend on n and grain
/// only, never on the number of threads. Every loop of the library writes disjoint results or reduces in a
/// fixed order: the same bits for every thread count. Throws Interrupted between ranges when the context was asked
/// to stop.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace conchoid
