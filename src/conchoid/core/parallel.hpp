#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace conchoid {

/// Calls body(begin, end) on disjoint ranges that cover [0, n), at most `grain` long, on the threads of the
/// current context (core/context.hpp), which stays the current one inside. The ranges depend on n and grain
/// only, never on the number of threads. Every loop of the library writes disjoint results or reduces in a
/// fixed order: the same bits for every thread count. Throws Interrupted between ranges when the context was asked
/// to stop.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// What a function says of 0 … n − 1, in this order, found by parallel_for. Results have a default.
template <class Of>
auto parallel_values(std::size_t n, std::size_t grain, const Of& of) {
  static_assert(!std::is_same_v<decltype(of(n)), bool>, "tasks would write into one word");
  std::vector<decltype(of(n))> all(n);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      all[i] = of(i);
  });
  return all;
}

}  // namespace conchoid
