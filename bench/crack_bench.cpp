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

// A flat crack of a given front that goes on by half an edge a frame. Fine front five times as fine.
class GrowingRibbon {
 public:
  /// @param edges  along the front's long sides; the ribbon is four edges wide
  explicit GrowingRibbon(int edges)
      : fine_((append_part(sheet_, testing::rectangle(edges * kEdge, 4 * kEdge, edges, 4)), sheet_),
              {.resolution = kEdge, .spacing = kEdge / 5}) {}
  void advance() {
    const SheetFront& front = sheet_.fronts[0];
    const auto frames = front_frames(sheet_, front);
    std::vector<FrontStep> steps;
    for (std::size_t i = 0; i < frames.size(); ++i)
      steps.push_back({front.nodes[i], frames[i], 0, 2e6});
    advance_fronts(sheet_, fine_, steps, model_, kEdge);
  }
  /// Least seconds of a frame of three.
  double frame_seconds() {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
      least = std::min(least, seconds([&] { advance(); }));
    return least;
  }
  std::size_t front_nodes() const { return sheet_.fronts[0].nodes.size(); }
  std::size_t triangles() const { return fine_.surface().triangle_count(); }

 private:
  static constexpr double kEdge = 0.01;
  CrackSheet sheet_;
  FineFront fine_;
  GrowthModel model_{std::make_shared<HoopStressLaw>(kGlassy), [](const Vec3&) {
                       return Toughness{1e6, Vec3::Zero()};
                     }};
};

// A frame of the coarse and the fine front together, per front node, beside that of a front of some 80 nodes. The ratio is how
// many times as many nodes there are where cost is linear in the front's length; `exponent` is what it is linear in.
void front_length(benchmark::State& state) {
  std::size_t many = 0, few = 0;
  const Times t = side_by_side(
      state,
      [&] {
        GrowingRibbon crack(static_cast<int>(state.range(0)));
        const double time = crack.frame_seconds();
        many = crack.front_nodes();
        return time;
      },
      [&] {
        GrowingRibbon crack(36);
        const double time = crack.frame_seconds();
        few = crack.front_nodes();
        return time;
      });
  state.counters["front_nodes"] = static_cast<double>(many);
  state.counters["us_per_node"] = 1e6 * t.fast / static_cast<double>(many);
  state.counters["exponent"] =
      std::log(t.fast / t.slow) / std::log(static_cast<double>(many) / static_cast<double>(few));
}

// A frame behind many others, beside the first ones of the same front: what has cracked does not count. Both per node.
void cracked_before(benchmark::State& state) {
  std::size_t triangles = 0, nodes = 0;
  side_by_side(
      state,
      [&] {
        GrowingRibbon crack(200);
        for (int i = 0; i < state.range(0); ++i)
          crack.advance();
        triangles = crack.triangles();
        nodes = crack.front_nodes();
        return crack.frame_seconds() / static_cast<double>(crack.front_nodes());
      },
      [&] {
        GrowingRibbon crack(200);
        return crack.frame_seconds() / static_cast<double>(crack.front_nodes());
      });
  state.counters["front_nodes"] = static_cast<double>(nodes);
  state.counters["fine_triangles"] = static_cast<double>(triangles);
}

}  // namespace

BENCHMARK(intensities)->Arg(8)->Arg(32)->Iterations(30)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(front_length)
    ->Arg(150)
    ->Arg(600)
    ->Arg(2400)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(cracked_before)->Arg(40)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
