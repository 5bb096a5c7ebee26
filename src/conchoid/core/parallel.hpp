#pragma once

#include <cstddef>
#include <functional>

namespace conchoid {

/// Number of worker threads every parallel loop may use (0: as many as the machine has). Set once by the
/// program; never changes a result: every loop writes disjoint results or reduces in a fixed order.
void set_thread_count(int threads);
int thread_count();

/// Calls body(begin, end) on disjoint ranges that cover [0, n), at most `grain` long, on the worker threads.
/// The ranges depend on n and grain only, never on the number of threads.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace conchoid
