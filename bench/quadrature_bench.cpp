#include <algorithm>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/quadrature/cases.hpp"
#include "quadrature/oracle.hpp"
#include "quadrature/pair_table.hpp"
#include "side_by_side.hpp"

// Pairs per second of the product against adaptive integration of the closed-form potential, both to the error that the body's own
// pairs are integrated to, or those with a crack's triangle.

namespace conchoid::bench {
namespace {

const double kBody = BemSettings{}.quadrature_tolerance, kCrack = crack_tolerance(kBody);
enum class Layout { far, coincident, common_edge, common_vertex, near };

struct Pair {
  Panel x, y;
};

// Pairs of a sphere's 320 triangles that the far rules take, every 97th of them.
std::vector<Pair> far_pairs_of_a_sphere(double tolerance) {
  const TriMesh sphere = icosphere(1, 2);
  std::vector<Panel> panels;
  for (std::size_t t = 0; t < sphere.triangle_count(); ++t)
    panels.push_back(make_panel(sphere.triangle(TriId(t)), sphere.corners[TriId(t)]));
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < panels.size() * panels.size(); i += 97) {
    const Panel &x = panels[i / panels.size()], &y = panels[i % panels.size()];
    if (shared_corners(x, y).count == 0 &&
        far_degrees(FarLimits(tolerance / 2), Layer::single, x, y).enough())
      pairs.push_back({x, y});
  }
  return pairs;
}

std::vector<Pair> pairs_of(Layout layout, double tolerance) {
  if (layout == Layout::far) return far_pairs_of_a_sphere(tolerance);
  std::vector<Pair> pairs;
  if (layout == Layout::coincident) {  // well shaped and slim
    for (const auto& p : oracle::common_edge_pairs())
      pairs.insert(pairs.end(), {{p.x, p.x}, {p.y, p.y}});
    return pairs;
  }
  for (const auto& p : layout == Layout::common_edge     ? oracle::common_edge_pairs()
                       : layout == Layout::common_vertex ? oracle::common_vertex_pairs()
                                                         : oracle::near_pairs())
    pairs.push_back({p.x, p.y});
  return pairs;
}

// `fast` takes all pairs, the oracle every `stride`-th.
template <class Integrals, class Fast, class Slow, class Error>
void compare_pairs(benchmark::State& state, const std::vector<Pair>& pairs, Fast fast, Slow slow,
                   Error error) {
  std::vector<PanelPair> all;
  for (const Pair& p : pairs)
    all.push_back({&p.x, &p.y});
  std::vector<Integrals> integrals(all.size());
  const std::size_t stride = pairs.size() > 100 ? 50 : 1;
  const std::size_t taken = (pairs.size() + stride - 1) / stride;
  const double share = static_cast<double>(taken) / static_cast<double>(pairs.size());
  const std::size_t rounds = pairs.size() > 100 ? 1 : 20;  // of the fast path: enough to be timed
  const Times t = side_by_side(
      state,
      [&] {
        return seconds([&] {
                 for (std::size_t round = 0; round < rounds; ++round) {
                   fast(all, integrals.data());
                   benchmark::DoNotOptimize(integrals.data());
                 }
               }) /
               static_cast<double>(rounds);
      },
      [&] {
        return seconds([&] {
          for (std::size_t i = 0; i < pairs.size(); i += stride)
            benchmark::DoNotOptimize(slow(pairs[i]));
        });
      },
      share);
  double worst = 0;
  for (std::size_t i = 0; i < pairs.size(); i += stride)
    worst = std::max(worst, error(pairs[i]));
  const auto n = static_cast<double>(pairs.size());
  state.counters["pairs_per_s"] = n / t.fast;
  state.counters["oracle_pairs_per_s"] = n / t.slow;
  state.counters["worst_error"] = worst;
}

void single_layer(benchmark::State& state, Layout layout, double tolerance) {
  const PairIntegrator integrator(tolerance);
  const auto fast = [&](const std::vector<PanelPair>& all, SingleLayerPair* out) {
    integrator.single_layer(all, out);
  };
  const auto slow = [&](const Pair& p) { return oracle::single_layer(p.x, p.y, tolerance); };
  compare_pairs<SingleLayerPair>(state, pairs_of(layout, tolerance), fast, slow, [&](const Pair& p) {
    return oracle::relative_error(oracle::family(integrator.single_layer(p.x, p.y)),
                                  oracle::single_layer(p.x, p.y, 1e-10));
  });
}

void double_layer(benchmark::State& state, Layout layout, double tolerance) {
  const PairIntegrator integrator(tolerance);
  const auto fast = [&](const std::vector<PanelPair>& all, DoubleLayerPair* out) {
    integrator.double_layer(all, out);
  };
  const auto slow = [&](const Pair& p) { return oracle::double_layer(p.x, p.y, tolerance); };
  compare_pairs<DoubleLayerPair>(state, pairs_of(layout, tolerance), fast, slow, [&](const Pair& p) {
    return oracle::double_layer_error(p.x, p.y, oracle::vector(integrator.double_layer(p.x, p.y)),
                                      oracle::double_layer(p.x, p.y, 1e-10));
  });
}

}  // namespace

// One layout to both errors.
#define CONCHOID_BENCHMARK_PAIRS(layer, layout, rounds)                \
  BENCHMARK_CAPTURE(layer, layout, Layout::layout, kBody)              \
      ->Iterations(rounds)                                             \
      ->UseManualTime()                                                \
      ->Unit(benchmark::kMillisecond);                                 \
  BENCHMARK_CAPTURE(layer, layout##_of_cracks, Layout::layout, kCrack) \
      ->Iterations(rounds)                                             \
      ->UseManualTime()                                                \
      ->Unit(benchmark::kMillisecond)

CONCHOID_BENCHMARK_PAIRS(single_layer, far, 20);
CONCHOID_BENCHMARK_PAIRS(single_layer, coincident, 10);
CONCHOID_BENCHMARK_PAIRS(single_layer, common_edge, 10);
CONCHOID_BENCHMARK_PAIRS(single_layer, common_vertex, 10);
CONCHOID_BENCHMARK_PAIRS(single_layer, near, 10);
CONCHOID_BENCHMARK_PAIRS(double_layer, far, 20);
CONCHOID_BENCHMARK_PAIRS(double_layer, near, 10);

}  // namespace conchoid::bench
