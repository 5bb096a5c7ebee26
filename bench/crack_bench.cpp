#include <cmath>
#include <numbers>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "crack/crack_samples.hpp"
#include "side_by_side.hpp"

namespace conchoid::bench {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

// Penny under tension σ: Δu = 8(1−ν²)σ/(πE) √(a² − r²), K_I = 2σ√(a/π).
struct Penny {
  double radius, stress = 1e6;
  TriMesh mesh;

  Penny(double a, int rings) : radius(a), mesh(testing::disc(a, rings)) {}
  IdVector<NodeId, Vec3> opening() const {
    const double nu = kGlassy.poisson_ratio;
    const double c = 8 * (1 - nu * nu) * stress / (std::numbers::pi * kGlassy.youngs_modulus);
    IdVector<NodeId, Vec3> out;
    for (const Vec3& x : mesh.positions)
      out.push_back(c * std::sqrt(std::max(0.0, radius * radius - x.squaredNorm())) * Vec3::UnitZ());
    return out;
  }
  double intensity() const { return 2 * stress * std::sqrt(radius / std::numbers::pi); }
};

// What the fit over several rows costs and brings against the one correlation node (here ratio < 1: the
// simple way is the cheaper one).
void intensities(benchmark::State& state) {
  const Penny penny(0.3, static_cast<int>(state.range(0)));
  const Front front = find_fronts(penny.mesh, {})[0];
  const auto opening = penny.opening();
  double error_two = 0, error_one = 0;
  const auto measure = [&](SifMethod method, double& error) {
    SifSettings settings{.method = method};
    settings.galerkin_openings = false;
    std::vector<Vec3> K;
    const double time =
        seconds([&] { K = stress_intensities(penny.mesh, front, opening, kGlassy, settings); });
    for (const Vec3& k : K)
      error = std::max(error, std::abs(k[0] / penny.intensity() - 1));
    return time;
  };
  const Times t = side_by_side(
      state, [&] { return measure(SifMethod::two_point, error_two); },
      [&] { return measure(SifMethod::one_point, error_one); });
  state.counters["front_nodes"] = static_cast<double>(front.nodes.size());
  state.counters["us_per_node"] = 1e6 * t.fast / static_cast<double>(front.nodes.size());
  state.counters["error_two_point"] = error_two;
  state.counters["error_one_point"] = error_one;
}

// One frame of the coarse and the fine front together; beside it the search for fronts that touch alone,
// which looks at every node against every edge (ratio: its share of the frame).
void front_advance(benchmark::State& state) {
  const int rings = static_cast<int>(state.range(0));
  const double edge = 1.0 / rings;
  CrackSheet start;
  append_part(start, testing::disc(1, rings));
  const FineFront fine_start(start, {.resolution = edge, .spacing = edge / 5});
  const auto frames = front_frames(start, start.fronts[0]);
  std::vector<FrontStep> steps;
  std::vector<FrontMotion> motions;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    steps.push_back({start.fronts[0].nodes[i], frames[i], 0.2, 2e6});
    motions.push_back({start.fronts[0].nodes[i], 0.5 * edge * frames[i].e2});
  }
  const auto law = std::make_shared<HoopStressLaw>(kGlassy);
  const ToughnessField toughness = [](const Vec3&) { return Toughness{1e6, Vec3::Zero()}; };
  side_by_side(
      state,
      [&] {
        CrackSheet sheet = start;
        FineFront fine = fine_start;
        return seconds([&] { advance_fronts(sheet, fine, steps, {law, toughness}, edge); });
      },
      [&] { return seconds([&] { benchmark::DoNotOptimize(touching_nodes(start, motions, edge)); }); });
  state.counters["front_nodes"] = static_cast<double>(frames.size());
}

}  // namespace

BENCHMARK(intensities)->Arg(8)->Arg(32)->Iterations(30)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(front_advance)->Arg(8)->Arg(32)->Iterations(10)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
