#include <cmath>
#include <ctime>
#include <limits>

#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/surface/fragments.hpp"
#include "intersect/cut_shapes.hpp"
#include "side_by_side.hpp"

namespace conchoid::bench {
namespace {

// A wavy sheet across the cube, n × n cells of two triangles, that sticks out on all sides.
TriMesh wavy_sheet(int n) {
  return shapes::sheet(-0.55, 0.55, -0.55, 0.55, n, n, [](double u, double v) {
    return Vec3(u, v, 0.013 + 0.1 * std::sin(5 * u) * std::cos(4 * v));
  });
}

double volume_error(const std::vector<Fragment>& fragments, const TriMesh& body) {
  double volume = 0;
  for (const Fragment& f : fragments)
    volume += f.volume;
  return std::abs(volume / enclosed_volume(body) - 1);
}

// The cube cut by a fine sheet; beside it the same cut by one of a 16th of the triangles. `exponent` is what the time goes with,
// `processor_us` the time of all threads for each triangle that comes out.
void fragments(benchmark::State& state) {
  const TriMesh body = built_in_model("cube").mesh;
  const TriMesh fine = wavy_sheet(static_cast<int>(state.range(0))),
                coarse = wavy_sheet(static_cast<int>(state.range(0)) / 4);
  std::vector<Fragment> pieces;
  const auto cut = [&](const TriMesh& sheet) {
    return seconds([&] { pieces = cut_into_fragments(body, {sheet}, {}); });
  };
  double error = 0, processor = std::numeric_limits<double>::infinity();
  std::size_t count = 0, triangles = 0;
  const Times t = side_by_side(
      state,
      [&] {
        const std::clock_t start = std::clock();
        const double time = cut(fine);
        processor = std::min(processor, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        error = volume_error(pieces, body);
        count = pieces.size();
        triangles = 0;
        for (const Fragment& piece : pieces)
          triangles += piece.mesh.triangle_count();
        return time;
      },
      [&] { return cut(coarse); });
  state.counters["sheet_triangles"] = static_cast<double>(fine.triangle_count());
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["processor_us"] = 1e6 * processor / static_cast<double>(triangles);
  state.counters["exponent"] =
      std::log(t.fast / t.slow) /
      std::log(static_cast<double>(fine.triangle_count()) / static_cast<double>(coarse.triangle_count()));
  state.counters["pieces"] = static_cast<double>(count);
  state.counters["volume_error"] = error;
}

// Cutting alone, as the elements need it (merged mouth) and as the fragments do (exact).
void cut_alone(benchmark::State& state) {
  const TriMesh body = built_in_model("cube").mesh;
  const TriMesh sheet = wavy_sheet(static_cast<int>(state.range(0)));
  const auto cut = [&](double merge) {
    return seconds([&] { benchmark::DoNotOptimize(corefine(body, sheet, {merge})); });
  };
  side_by_side(
      state, [&] { return cut(0); }, [&] { return cut(0.1); });
  state.counters["sheet_triangles"] = static_cast<double>(sheet.triangle_count());
}

std::size_t overlaps_one_by_one(const TriMesh& a, const TriMesh& b) {
  const auto boxes = [](const TriMesh& mesh) {
    std::vector<Box> out;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const Triangle x = mesh.triangle(TriId(t));
      out.push_back({x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])});
    }
    return out;
  };
  const std::vector<Box> in_a = boxes(a), in_b = boxes(b);
  std::size_t count = 0;
  for (const Box& p : in_a)
    for (const Box& q : in_b)
      if ((p.low.array() <= q.high.array()).all() && (q.low.array() <= p.high.array()).all()) ++count;
  return count;
}

// Which triangles may meet: the search against every pair.
void meeting_triangles(benchmark::State& state) {
  const TriMesh body = box_mesh({1, 1, 1}, 32, 32, 32);
  const TriMesh sheet = wavy_sheet(static_cast<int>(state.range(0)));
  std::size_t found = 0, all = 0;
  side_by_side(
      state, [&] { return seconds([&] { found = overlapping_boxes(body, sheet).size(); }); },
      [&] { return seconds([&] { all = overlaps_one_by_one(body, sheet); }); });
  if (found != all) state.SkipWithError("the search and the oracle disagree");
  state.counters["pairs"] = static_cast<double>(found);
}

}  // namespace

BENCHMARK(fragments)->Arg(64)->Arg(256)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(cut_alone)->Arg(64)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(meeting_triangles)->Arg(64)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
