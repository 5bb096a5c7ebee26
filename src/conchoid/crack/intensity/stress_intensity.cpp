#include "conchoid/crack/intensity/stress_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/intensity/front_distance.hpp"
#include "conchoid/crack/intensity/intensity_fit.hpp"
#include "conchoid/crack/intensity/kinks_behind.hpp"

namespace conchoid {

namespace {

/// K / (Δu/√r) for the three modes [Pa].
Vec3 intensity_factors(const ElasticConstants& m, SifConvention convention) {
  const double shared = m.shear_modulus() * std::sqrt(2 * std::numbers::pi) / 4;
  const double scale = convention == SifConvention::half_opening ? 2 * shared : shared;
  return {scale / (1 - m.poisson_ratio), scale / (1 - m.poisson_ratio), scale};
}

/// Values known at some nodes of the front, carried to the others from the nearest one that has one (mean of
/// both sides at equal distance).
std::vector<Vec3> fill_from_nearest(const std::vector<Vec3>& values, const std::vector<bool>& known,
                                    bool closed) {
  const std::size_t n = values.size();
  std::vector<Vec3> filled = values;
  for (std::size_t i = 0; i < n; ++i) {
    if (known[i]) continue;
    std::size_t back = i, ahead = i;
    for (std::size_t step = 0; step < n && !known[back] && !known[ahead]; ++step) {
      back = previous_index(back, n, closed);
      ahead = next_index(ahead, n, closed);
    }
    if (known[back] && known[ahead])
      filled[i] = 0.5 * (values[back] + values[ahead]);
    else if (known[back] || known[ahead])
      filled[i] = values[known[back] ? back : ahead];
    else
      filled[i] = Vec3::Zero();
  }
  return filled;
}

/// Third corner of the triangle that carries each front edge.
std::vector<NodeId> nodes_across_front_edges(const TriMesh& crack, const Front& front) {
  const std::size_t n = front.nodes.size(), edges = edge_count(n, front.closed);
  std::vector<std::pair<Edge, std::size_t>> wanted;
  for (std::size_t i = 0; i < edges; ++i)
    wanted.emplace_back(Edge(front.nodes[i], front.nodes[next_index(i, n, front.closed)]), i);
  std::sort(wanted.begin(), wanted.end());
  std::vector<NodeId> across(edges);
  for (const auto& corners : crack.corners)
    for (int k = 0; k < 3; ++k) {
      const Edge edge(corners[k], corners[(k + 1) % 3]);
      const auto at = std::lower_bound(wanted.begin(), wanted.end(), std::make_pair(edge, std::size_t{0}));
      if (at != wanted.end() && at->first == edge) across[at->second] = corners[(k + 2) % 3];
    }
  return across;
}

std::vector<Vec3> one_point_rates(const TriMesh& crack, const Front& front,
                                  const IdVector<NodeId, Vec3>& opening) {
  const std::size_t n = front.nodes.size();
  const std::vector<NodeId> across = nodes_across_front_edges(crack, front);
  const std::vector<bool> on_front = front_marks(boundary_marks(crack), front, opening);
  std::vector<Vec3> sum(n, Vec3::Zero());
  std::vector<int> count(n, 0);
  for (std::size_t i = 0; i < across.size(); ++i) {
    const NodeId node = across[i];
    if (!node.valid() || on_front[node.index()]) continue;
    const FrontFoot foot =
        closest_foot(crack, front, crack.positions[node], {static_cast<std::ptrdiff_t>(i), 1});
    if (!(foot.distance > 0)) continue;
    const Vec3 rate = in_frame(frame_at(front, foot), opening[node]) / std::sqrt(foot.distance);
    for (std::size_t end : {i, next_index(i, n, front.closed)}) {
      sum[end] += rate;
      ++count[end];
    }
  }
  std::vector<bool> known(n);
  for (std::size_t i = 0; i < n; ++i) {
    known[i] = count[i] > 0;
    if (known[i]) sum[i] /= count[i];
  }
  return fill_from_nearest(sum, known, front.closed);
}

std::vector<Vec3> fitted_rates(const TriMesh& crack, const Front& front,
                               const IdVector<NodeId, Vec3>& opening, bool galerkin_openings) {
  const std::size_t n = front.nodes.size();
  SheetBehind behind{NodeLinks(crack), {}, {}, boundary_marks(crack)};
  behind.rows = rows_behind(crack, behind.links, front, front_marks(behind.mouth, front, opening));
  behind.kinks = kinks_behind(crack, behind.links, front, behind.rows);
  std::vector<Vec3> rates(n, Vec3::Zero());
  std::vector<bool> known(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !front.closed && n > 2 && (i == 0 || i + 1 == n);
    if (end) continue;
    known[i] = fit_rate(gather_samples(crack, front, i, behind, opening, galerkin_openings),
                        galerkin_openings, rates[i]);
  }
  return fill_from_nearest(rates, known, front.closed);
}

}  // namespace

Vec3 stress_intensity(const Vec3& opening, double r, const ElasticConstants& m, SifConvention convention) {
  return intensity_factors(m, convention).cwiseProduct(opening) / std::sqrt(r);
}

Vec3 opening_from_intensity(const Vec3& K, double r, const ElasticConstants& m, SifConvention convention) {
  return K.cwiseQuotient(intensity_factors(m, convention)) * std::sqrt(r);
}

std::vector<Vec3> stress_intensities(const TriMesh& crack, const Front& front,
                                     const IdVector<NodeId, Vec3>& opening, const ElasticConstants& m,
                                     const SifSettings& settings) {
  std::vector<Vec3> K = settings.method == SifMethod::one_point
                            ? one_point_rates(crack, front, opening)
                            : fitted_rates(crack, front, opening, settings.galerkin_openings);
  const Vec3 factors = intensity_factors(m, settings.convention);
  for (Vec3& k : K)
    k = k.cwiseProduct(factors);
  return K;
}

}  // namespace conchoid
