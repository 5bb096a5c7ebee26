#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>

#include "conchoid/bem/bordered_cholesky.hpp"
#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/mesh/models.hpp"
#include "crack/crack_samples.hpp"
#include "side_by_side.hpp"

namespace conchoid::bench {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

enum class BodyKind { cube, thousand };

/// The built-in cube (120 triangles) or a box of 972.
TriMesh body_mesh(BodyKind kind) {
  return kind == BodyKind::cube ? built_in_model("cube").mesh : box_mesh({1, 1, 1}, 9, 9, 9);
}

enum class Support { pulled, held };

/// Pulled at z+, and at z- pulled the other way or held.
BoundaryData load(const TriMesh& mesh, Support support) {
  BoundaryData data = free_surface(mesh);
  const Box box = bounding_box(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double z = centroid(mesh, TriId(t)).z();
    if (z == box.high.z()) data.traction[t] = {0, 0, 1e8};
    if (z != box.low.z()) continue;
    if (support == Support::held)
      data.kind[t] = BoundaryKind::displacement;
    else
      data.traction[t] = {0, 0, -1e8};
  }
  return data;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return difference / size;
}

// D of the free nodes and, where the body is held, K at the default tolerance against 1e-10.
std::vector<double> assembled(const TriMesh& mesh, const BoundaryData& data, double tolerance) {
  const BodyDiscretisation body(mesh, data.kind, kGlassy, tolerance);
  BodyEntries entries(body);
  entries.keep_pairs();
  const std::size_t nq = body.tractions(), nu = body.displacements();
  std::vector<double> out(nu * (nq + nu));
  parallel_for(body.free_nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
    entries.hypersingular(std::span(body.free_nodes).subspan(begin, end - begin), body.free_nodes,
                          {&out[3 * begin * nu], nu, 1});
  });
  parallel_for(body.held_triangles.size(), 4, [&](std::size_t begin, std::size_t end) {
    entries.double_layer(std::span(body.held_triangles).subspan(begin, end - begin), body.free_nodes,
                         {&out[nu * nu + 3 * begin * nu], nu, 1});
  });
  return out;
}

void assembly(benchmark::State& state, BodyKind kind, Support support) {
  const TriMesh mesh = body_mesh(kind);
  const BoundaryData data = load(mesh, support);
  std::vector<double> fast, slow;
  const auto assemble = [&](double tolerance, std::vector<double>& out) {
    return seconds([&] { out = assembled(mesh, data, tolerance); });
  };
  const Times t = side_by_side(
      state, [&] { return assemble(BemSettings{}.quadrature_tolerance, fast); },
      [&] { return assemble(1e-10, slow); });
  const auto n = static_cast<double>(mesh.triangle_count());
  state.counters["triangles"] = n;
  state.counters["pairs_per_s"] = n * (n + 1) / 2 / t.fast;
  state.counters["worst_difference"] = largest_difference(fast, slow);
}

// Assembled and factored; the slow way assembles at 1e-10. Goal for about 1,000 triangles on two cores: 3 s.
void body_ready(benchmark::State& state, BodyKind kind, Support support) {
  const TriMesh mesh = body_mesh(kind);
  const BoundaryData data = load(mesh, support);
  std::size_t bytes = 0;
  const auto make = [&](double tolerance) {
    return seconds([&] {
      bytes = make_body_operator(mesh, data, kGlassy, {.quadrature_tolerance = tolerance})->bytes();
    });
  };
  const Times t = side_by_side(
      state, [&] { return make(BemSettings{}.quadrature_tolerance); }, [&] { return make(1e-10); });
  state.counters["triangles"] = static_cast<double>(mesh.triangle_count());
  state.counters["megabytes"] = 1e-6 * static_cast<double>(bytes);
  if (kind == BodyKind::thousand) state.SetLabel(t.fast < 3 ? "goal 3 s: met" : "goal 3 s: missed");
}

Eigen::MatrixXd random_spd(Eigen::Index n) {
  std::mt19937_64 random(7);
  Eigen::MatrixXd a(n, n);
  for (double& v : a.reshaped())
    v = static_cast<double>(random() >> 11) * 0x1.0p-53 - 0.5;
  return a * a.transpose() + static_cast<double>(n) * Eigen::MatrixXd::Identity(n, n);
}

/// Rows of a symmetric matrix from `first` on, which are its columns.
std::function<const double*(std::size_t)> rows_from(const Eigen::MatrixXd& a, Eigen::Index first) {
  return [&a, first](std::size_t i) { return a.col(first + static_cast<Eigen::Index>(i)).data(); };
}

void factorisation(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Eigen::MatrixXd a = random_spd(n);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1, 1), exact = x;
  bool definite = true;
  const Times t = side_by_side(
      state,
      [&] {
        BorderedCholesky factor;
        const double time =
            seconds([&] { definite = factor.append(static_cast<std::size_t>(n), rows_from(a, 0)); });
        x = Eigen::VectorXd::LinSpaced(n, -1, 1);
        factor.solve(x.data());
        return time;
      },
      [&] {
        std::optional<Eigen::LLT<Eigen::MatrixXd>> factor;
        const double time = seconds([&] { factor.emplace(a); });
        exact = factor->solve(Eigen::VectorXd::LinSpaced(n, -1, 1));
        return time;
      });
  if (!definite) return state.SkipWithError("not positive definite");
  state.counters["gflops"] = std::pow(static_cast<double>(n), 3) / 3 / t.fast * 1e-9;
  state.counters["worst_difference"] = (x - exact).norm() / exact.norm();
}

// A ring of 90 unknowns appended to a factor of 1,500 against the whole of it anew.
void appended_ring(benchmark::State& state) {
  constexpr Eigen::Index n = 1500, m = 90;
  const Eigen::MatrixXd a = random_spd(n + m);
  BorderedCholesky grown;
  bool definite = grown.append(n, rows_from(a, 0));
  side_by_side(
      state,
      [&] {
        grown.truncate(n);
        return seconds([&] { definite = grown.append(m, rows_from(a, n)) && definite; });
      },
      [&] {
        BorderedCholesky anew;
        return seconds([&] { definite = anew.append(n + m, rows_from(a, 0)) && definite; });
      });
  if (!definite) state.SkipWithError("not positive definite");
}

// A disc of five rings across the body's face x-, and what every further advance of all its front makes of it.
std::vector<CutComplex> growing_crack(const TriMesh& surface, int frames) {
  CrackSheet sheet;
  append_part(sheet, testing::transformed(testing::disc(0.3, 5), Mat3::Identity(), {-0.49, 0.013, 0.017}));
  std::vector<CutComplex> out{corefine(surface, sheet.mesh, {0.1})};
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<FrontMotion> motions;
    const auto at = front_frames(sheet, sheet.fronts[0]);
    for (std::size_t i = 0; i < at.size(); ++i)
      motions.push_back({sheet.fronts[0].nodes[i], 0.06 * at[i].e2});
    advance(sheet, motions, 0.06, {.smoothing = 0});
    out.push_back(corefine(surface, sheet.mesh, {0.1}));
  }
  return out;
}

// The crack grown by a ring: appended to a body that has it already, against a body and crack made anew.
void grown_crack(benchmark::State& state, BodyKind kind) {
  const TriMesh mesh = body_mesh(kind);
  const BoundaryData data = load(mesh, Support::pulled);
  const std::vector<CutComplex> crack = growing_crack(mesh, 1);
  CrackedBody body = make_cracked_body(mesh, data, kGlassy);
  std::optional<CrackedBody> anew;
  AppendStatistics statistics;
  side_by_side(
      state,
      [&] {
        body.set_crack(crack[0]);
        const double time = seconds([&] { body.set_crack(crack[1]); });
        statistics = body.statistics();
        return time;
      },
      [&] {
        return seconds([&] {
          anew.emplace(make_cracked_body(mesh, data, kGlassy));
          anew->set_crack(crack[1]);
        });
      });
  body.solve();
  anew->solve();
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < body.opening().size(); ++i) {
    difference = std::max(difference, (body.opening()[NodeId(i)] - anew->opening()[NodeId(i)]).norm());
    largest = std::max(largest, anew->opening()[NodeId(i)].norm());
  }
  state.counters["functions"] = static_cast<double>(statistics.functions);
  state.counters["assembled"] = static_cast<double>(statistics.assembled);
  state.counters["refactored"] = static_cast<double>(statistics.refactored);
  state.counters["worst_difference"] = difference / largest;
}

/// Slope of log y over log x by least squares.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Every frame of a crack that grows through half of the body: seconds over new functions × (nodes of the body + functions of the
// crack). `exponent` is what they go with. Beside it the last one by a body and a crack made anew.
void growth(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const TriMesh mesh = box_mesh({1, 1, 1}, cells, cells, cells);
  const BoundaryData data = load(mesh, Support::pulled);
  const std::vector<CutComplex> crack = growing_crack(mesh, 8);
  std::vector<double> time(crack.size() - 1, std::numeric_limits<double>::infinity()), size(time.size());
  AppendStatistics last;
  side_by_side(
      state,
      [&] {
        CrackedBody body = make_cracked_body(mesh, data, kGlassy);
        body.set_crack(crack[0]);
        body.solve();
        for (std::size_t frame = 0; frame < time.size(); ++frame) {
          const double t = seconds([&] {
            body.set_crack(crack[frame + 1]);
            body.solve();
          });
          time[frame] = std::min(time[frame], t);
          last = body.statistics();
          size[frame] =
              static_cast<double>(last.assembled) * static_cast<double>(mesh.node_count() + last.functions);
        }
        return time.back();
      },
      [&] {
        return seconds([&] {
          CrackedBody body = make_cracked_body(mesh, data, kGlassy);
          body.set_crack(crack.back());
          body.solve();
        });
      });
  state.counters["body_nodes"] = static_cast<double>(mesh.node_count());
  state.counters["functions"] = static_cast<double>(last.functions);
  state.counters["assembled"] = static_cast<double>(last.assembled);
  state.counters["first_frame_ms"] = 1e3 * time.front();
  state.counters["ns_per_pair"] = 1e9 * time.back() / size.back();
  state.counters["exponent"] = exponent(size, time);
}

}  // namespace

BENCHMARK_CAPTURE(assembly, cube, BodyKind::cube, Support::pulled)
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, cube_held, BodyKind::cube, Support::held)
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, box_972, BodyKind::thousand, Support::pulled)
    ->Iterations(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(body_ready, box_972, BodyKind::thousand, Support::pulled)
    ->Iterations(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(body_ready, box_972_held, BodyKind::thousand, Support::held)
    ->Iterations(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(factorisation)->Arg(1500)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(appended_ring)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(grown_crack, cube, BodyKind::cube)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(grown_crack, box_972, BodyKind::thousand)
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(growth)->Arg(6)->Arg(12)->Iterations(2)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
