#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>

/// A fast path and the slow way to the same result, timed in turns in one run, so that what else the machine
/// does at the time spoils neither against the other.
namespace conchoid::bench {

/// Wall-clock seconds that `work` takes.
template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Times {
  double fast, slow;  ///< least of all repetitions [s]
};

/// Runs both once per iteration. The benchmark's own time is that of `fast`; counters: fast_ms, slow_ms and
/// ratio = slow / fast, each from the least times. Both return the seconds that count, so that what they do
/// beside (copying their input) does not.
/// @param share  part of the slow way's work that is done: its time is divided by it
template <class Fast, class Slow>
Times side_by_side(benchmark::State& state, Fast fast, Slow slow, double share = 1) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Times least{never, never};
  for (auto _ : state) {
    const double t = fast();
    state.SetIterationTime(t);
    least.fast = std::min(least.fast, t);
    least.slow = std::min(least.slow, slow() / share);
  }
  state.counters["fast_ms"] = 1e3 * least.fast;
  state.counters["slow_ms"] = 1e3 * least.slow;
  state.counters["ratio"] = least.slow / least.fast;
  return least;
}

}  // namespace conchoid::bench
