#include <cmath>
#include <ctime>

#include "conchoid/sim/run.hpp"
#include "side_by_side.hpp"

// Whole runs of examples/cube.toml, cut into pieces, nothing written.

namespace conchoid::bench {
namespace {

Scene cube() {
  Scene scene = read_scene(CONCHOID_SOURCE_DIR "/examples/cube.toml");
  scene.run.max_cracks = 1;
  return scene;
}

RunResult run(const Scene& scene, const std::string& method) {
  RunOptions options;
  options.method = method;
  options.progress = false;
  return run_scene(scene, options);
}

void add_split(benchmark::State& state, const RunDocument& doc) {
  state.counters["frames"] = doc.frames;
  state.counters["opening_ms"] = 1e3 * doc.opening_seconds;
  state.counters["fracture_ms"] = 1e3 * doc.fracture_seconds;
  state.counters["other_ms"] = 1e3 * doc.other_seconds;
  state.counters["pieces"] = static_cast<double>(doc.fragments.size());
}

// By boundary elements at the default tolerance, against 1e-10. Goal: 0.5 s.
void cube_solved(benchmark::State& state) {
  const Scene fast = cube();
  Scene slow = fast;
  slow.run.quadrature_tolerance = 1e-10;
  RunResult a, b;
  double processor = 1e30;  // seconds of all threads together: what a busy machine changes least
  const Times t = side_by_side(
      state,
      [&] {
        const std::clock_t start = std::clock();
        const double time = seconds([&] { a = run(fast, "bem"); });
        processor = std::min(processor, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        return time;
      },
      [&] { return seconds([&] { b = run(slow, "bem"); }); });
  add_split(state, a.document);
  state.counters["processor_ms"] = 1e3 * processor;
  if (!a.fragments.empty() && !b.fragments.empty())
    state.counters["volume_difference"] = std::abs(a.fragments[0].volume - b.fragments[0].volume);
  state.SetLabel((t.fast < 0.5 ? "goal 0.5 s: met, " : "goal 0.5 s: missed, ") +
                 std::string(name(a.document.stop)));
}

// Predicted after frame 1 without a forest ("K stays as it is"), against solved.
void cube_predicted(benchmark::State& state) {
  const Scene scene = cube();
  RunResult a, b;
  side_by_side(
      state, [&] { return seconds([&] { a = run(scene, "steady"); }); },
      [&] { return seconds([&] { b = run(scene, "bem"); }); });
  add_split(state, a.document);
  state.counters["opening_ratio"] =
      b.document.opening_seconds_per_frame / a.document.opening_seconds_per_frame;
  state.SetLabel(std::string(name(a.document.stop)));
}

// A crack in varying toughness, swept at half the spacing. Goal: at most five times the price, which is what
// the ratio says, and the same boundary elements.
void surface_refined(benchmark::State& state) {
  Scene coarse = read_scene(CONCHOID_SOURCE_DIR "/examples/noise.toml"), fine = coarse;
  fine.resolution.surface = *coarse.resolution.surface / 2;
  RunResult a, b;
  const Times t = side_by_side(
      state, [&] { return seconds([&] { a = run(coarse, "bem"); }); },
      [&] { return seconds([&] { b = run(fine, "bem"); }); });
  add_split(state, a.document);
  double difference = 0;  // of K, in the last rows of both
  if (!a.front.empty() && !b.front.empty())
    difference = std::abs(a.front.back().intensity[0] - b.front.back().intensity[0]);
  state.counters["intensity_difference"] = difference;
  state.SetLabel((t.slow < 5 * t.fast ? "goal 5: met, " : "goal 5: missed, ") +
                 std::string(name(a.document.stop)));
}

}  // namespace

BENCHMARK(cube_solved)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(cube_predicted)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(surface_refined)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
