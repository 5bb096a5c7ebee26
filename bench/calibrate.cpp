// The unit of time in which speed goals are given: fixed work of floating point, branches and memory. Prints the seconds that
// it takes on this machine, the least of five.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
  constexpr std::size_t n = 512, memory = std::size_t{1} << 22;
  constexpr std::uint32_t steps = 4000000;
  double best = 1e9, sink = 0;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    static std::array<double, n * n> a, b, c;
    for (std::size_t i = 0; i < n * n; ++i) {
      a[i] = static_cast<double>(i % 7) - 3;
      b[i] = static_cast<double>(i % 5) - 2;
      c[i] = 0;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
          c[i * n + j] += a[i * n + k] * b[k * n + j];
    for (std::uint32_t i = 1; i < steps; ++i)
      sink += 1 / std::sqrt(i + c[i % (n * n)] * 1e-9);
    std::vector<std::uint32_t> cells(memory);
    std::uint32_t s = 1, at = 0;
    for (std::uint32_t& cell : cells)
      cell = s = s * 1664525U + 1013904223U;
    for (std::uint32_t i = 0; i < steps; ++i)
      at = cells[at & (memory - 1)] ^ i;
    sink += at;
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%.4f %g\n", best, sink);
}
