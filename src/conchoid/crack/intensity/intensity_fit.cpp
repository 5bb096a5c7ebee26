#include "conchoid/crack/intensity/intensity_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/intensity/front_distance.hpp"
#include "conchoid/crack/intensity/kinks_behind.hpp"
#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

double mean_edge_length(const TriMesh& crack, const Front& front, std::size_t i) {
  const std::size_t n = front.nodes.size();
  const std::size_t before = previous_index(i, n, front.closed), after = next_index(i, n, front.closed);
  const Vec3& x = crack.positions[front.nodes[i]];
  const double sum =
      (x - crack.positions[front.nodes[before]]).norm() + (x - crack.positions[front.nodes[after]]).norm();
  return before == i || after == i ? sum : 0.5 * sum;
}

/// Nodes behind front node i, reached through the mesh from it and its neighbours on the front, row by row.
std::vector<NodeId> nodes_behind(const TriMesh& crack, const NodeLinks& links, const Front& front,
                                 std::size_t i, const std::vector<int>& rows, double farthest) {
  const std::size_t n = front.nodes.size();
  std::vector<NodeId> layer{front.nodes[previous_index(i, n, front.closed)], front.nodes[i],
                            front.nodes[next_index(i, n, front.closed)]};
  const Vec3& center = crack.positions[front.nodes[i]];
  std::vector<NodeId> seen, found;
  while (!layer.empty()) {
    std::vector<NodeId> next;
    for (NodeId from : layer)
      for (const NodeId* to = links.begin(from); to != links.end(from); ++to) {
        if (rows[to->index()] == 0 || (crack.positions[*to] - center).norm() > farthest) continue;
        const auto at = std::lower_bound(seen.begin(), seen.end(), *to);
        if (at != seen.end() && *at == *to) continue;
        seen.insert(at, *to);
        next.push_back(*to);
      }
    std::sort(next.begin(), next.end());
    found.insert(found.end(), next.begin(), next.end());
    layer = std::move(next);
  }
  return found;
}

/// Arc length from front node i to the foot; feet are at most two edges away.
double along_front(const TriMesh& crack, const Front& front, std::size_t i, const FrontFoot& foot) {
  const std::size_t n = front.nodes.size();
  const auto length = [&](std::size_t edge) {
    return (crack.positions[front.nodes[next_index(edge, n, front.closed)]] -
            crack.positions[front.nodes[edge]])
        .norm();
  };
  double ahead = 0, behind = 0;
  std::size_t forward = i, backward = i;
  for (int step = 0; step < 3; ++step) {
    if (foot.edge == forward) return ahead + foot.fraction * length(forward);
    ahead += length(forward);
    forward = next_index(forward, n, front.closed);
    backward = previous_index(backward, n, front.closed);
    behind += length(backward);
    if (foot.edge == backward) return -behind + foot.fraction * length(backward);
  }
  return ahead;
}

Vec3 point_at(const TriMesh& crack, const Front& front, const FrontFoot& foot) {
  const std::size_t next = next_index(foot.edge, front.nodes.size(), front.closed);
  const Vec3 &a = crack.positions[front.nodes[foot.edge]], &b = crack.positions[front.nodes[next]];
  return a + foot.fraction * (b - a);
}

double weight(const OpeningSample& sample, bool galerkin_openings) {
  const double thin = std::min(1.0, sample.r / kFitFullWeight);
  const double s = sample.s / kFitReachAlong;
  const double near = (1 - s * s) / (1 + 0.25 * sample.r * sample.r);
  return thin * thin * near * near * (galerkin_openings && sample.row == 1 ? kFirstRowWeight : 1.0);
}

/// Weights of all samples: 0 behind a kink, and at a kink only as much as the smooth rows beyond the first, which
/// counts little, do not outweigh it.
std::vector<double> weights(const std::vector<OpeningSample>& samples, bool galerkin_openings) {
  std::vector<double> all, ahead, at_kink;
  double sum_all = 0, sum_ahead = 0, smooth = 0, kinked = 0;
  for (const OpeningSample& sample : samples) {
    all.push_back(weight(sample, galerkin_openings));
    ahead.push_back(all.back() * share_behind_turn(sample.turn));
    at_kink.push_back(1 - share_behind_turn(std::abs(sample.kink)));
    sum_all += all.back();
    sum_ahead += ahead.back();
    if (sample.row > 1) smooth += (1 - at_kink.back()) * ahead.back();
    kinked += at_kink.back() * ahead.back();
  }
  if (sum_ahead < kLeastShareAhead * sum_all) return all;
  if (!(kinked > 0)) return ahead;
  const double needless = std::min(1.0, smooth / kinked);
  for (std::size_t k = 0; k < samples.size(); ++k)
    ahead[k] *= 1 - at_kink[k] * needless;
  return ahead;
}

/// Takes the Galerkin solution's deviation out of the rates.
void remove_element_bias(std::vector<OpeningSample>& samples) {
  double first_row = 0, count = 0;
  for (const OpeningSample& sample : samples)
    if (sample.row == 1) {
      first_row += sample.r;
      ++count;
    }
  if (count == 0) return;
  const double shift = kFrontShift * first_row / count;
  for (OpeningSample& sample : samples)
    sample.rate /= sample.row == 1 ? kFirstRowExcess : std::sqrt(std::max(0.5, 1 - shift / sample.r));
}

/// A, A', A", B by least squares.
using Fit = Eigen::Matrix<double, 4, 3>;

Eigen::Vector4d terms(const OpeningSample& sample) {
  return {1, sample.s, sample.s * sample.s, sample.r};
}

Fit fitted(const std::vector<OpeningSample>& samples, const std::vector<double>& weight_of,
           bool galerkin_openings) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Fit right = Fit::Zero();
  double total = 0;
  for (const double w : weight_of)
    total += w;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Eigen::Vector4d row = terms(samples[k]);
    const double w = weight_of[k] / total;
    normal += w * row * row.transpose();
    right += w * row * samples[k].rate.transpose();
  }
  for (int k = 1; k < 4; ++k)
    normal(k, k) += kFitRidge[k - 1];
  if (galerkin_openings) normal(3, 3) += kFitRidgeGalerkin;
  return normal.ldlt().solve(right);
}

/// Share of the rows beyond the first between which and the front the sheet is smooth.
double smooth_share(const std::vector<OpeningSample>& samples) {
  double all = 0, smooth = 0;
  for (const OpeningSample& sample : samples) {
    if (sample.row == 1) continue;
    const double w = weight(sample, true);
    all += w;
    smooth += w * share_behind_turn(0.5 * std::max(sample.turn, std::abs(sample.kink)));
  }
  return all > 0 ? smooth / all : 0;
}

/// The first row scatters in how much it opens, not in which direction: with its excess along the fit taken out it
/// counts like the others, and tells turns of K that these are too far behind to have seen. Near a kink it does not,
/// as it opens in another direction than the front, nor at a mouth, the least flat part of the crack.
std::vector<OpeningSample> directed(std::vector<OpeningSample> samples, const Fit& fit,
                                    std::vector<double>& weight_of) {
  const double more = 1 + (1 / kFirstRowWeight - 1) * smooth_share(samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples[k].row != 1 || samples[k].mouth) continue;
    const Vec3 expected = fit.transpose() * terms(samples[k]);
    const double excess = samples[k].rate.dot(expected) / expected.squaredNorm();
    if (!(std::abs(excess - 1) < kFirstRowScatter)) continue;
    samples[k].rate /= excess;
    weight_of[k] *= more;
  }
  return samples;
}

}  // namespace

NodeLinks::NodeLinks(const TriMesh& mesh) : first_(mesh.node_count() + 1, 0) {
  std::vector<std::pair<NodeId, NodeId>> pairs;
  pairs.reserve(6 * mesh.triangle_count());
  for (const auto& c : mesh.corners)
    for (int k = 0; k < 3; ++k) {
      pairs.emplace_back(c[k], c[(k + 1) % 3]);
      pairs.emplace_back(c[(k + 1) % 3], c[k]);
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  targets_.reserve(pairs.size());
  for (const auto& [from, to] : pairs) {
    ++first_[from.index() + 1];
    targets_.push_back(to);
  }
  for (std::size_t i = 1; i < first_.size(); ++i)
    first_[i] += first_[i - 1];
}

std::vector<bool> boundary_marks(const TriMesh& crack) {
  std::vector<bool> marks(crack.node_count(), false);
  const auto neighbours = triangle_neighbours(crack);
  for (std::size_t t = 0; t < crack.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (neighbours[TriId(t)][k].valid()) continue;
      const auto& c = crack.corners[TriId(t)];
      for (NodeId node : {c[k], c[(k + 1) % 3]})
        marks[node.index()] = true;
    }
  return marks;
}

std::vector<bool> front_marks(const std::vector<bool>& boundary, const Front& front,
                              const IdVector<NodeId, Vec3>& opening) {
  std::vector<bool> marks = boundary;
  for (std::size_t n = 0; n < marks.size(); ++n)
    marks[n] = marks[n] && opening[NodeId(n)].isZero(0);
  for (NodeId node : front.nodes)
    marks[node.index()] = true;
  return marks;
}

std::vector<int> rows_behind(const TriMesh& crack, const NodeLinks& links, const Front& front,
                             const std::vector<bool>& on_front) {
  std::vector<int> rows(crack.node_count(), 0);
  std::vector<NodeId> layer = front.nodes;
  for (int row = 1; row <= kFitRows && !layer.empty(); ++row) {
    std::vector<NodeId> next;
    for (NodeId from : layer)
      for (const NodeId* to = links.begin(from); to != links.end(from); ++to) {
        if (on_front[to->index()] || rows[to->index()] != 0) continue;
        rows[to->index()] = row;
        next.push_back(*to);
      }
    layer = std::move(next);
  }
  return rows;
}

std::vector<OpeningSample> gather_samples(const TriMesh& crack, const Front& front, std::size_t i,
                                          const SheetBehind& behind, const IdVector<NodeId, Vec3>& opening,
                                          bool galerkin_openings) {
  const double h = mean_edge_length(crack, front, i);
  std::vector<OpeningSample> samples;
  if (!(h > 0)) return samples;
  for (NodeId node :
       nodes_behind(crack, behind.links, front, i, behind.rows, (kFitReachBehind + kFitReachAlong) * h)) {
    const FrontFoot foot = closest_foot(crack, front, crack.positions[node], edges_around(i, 2));
    if (foot.clipped) continue;
    OpeningSample sample;
    sample.r = foot.distance / h;
    sample.s = along_front(crack, front, i, foot) / h;
    if (!(sample.r > 1e-3) || sample.r > kFitReachBehind || std::abs(sample.s) >= kFitReachAlong) continue;
    const FrontFrame frame = frame_at(front, foot);
    sample.row = behind.rows[node.index()];
    sample.mouth = behind.mouth[node.index()];
    const Vec3 du = opening[node] / std::sqrt(foot.distance);
    const KinkBehind& kink = behind.kinks[node.index()];
    const double height = frame.e1.dot(crack.positions[node] - point_at(crack, front, foot));
    sample.turn = kink.turn;
    sample.kink = kink.kink;
    sample.rate = without_kink(in_frame(frame, du), kink.kink);
    sample.rate[1] -= sample.rate[0] * height / (2 * foot.distance);  // (S12)
    samples.push_back(sample);
  }
  if (galerkin_openings) remove_element_bias(samples);
  return samples;
}

bool fit_rate(const std::vector<OpeningSample>& samples, bool galerkin_openings, Vec3& rate) {
  if (samples.empty()) return false;
  std::vector<double> weight_of = weights(samples, galerkin_openings);
  double total = 0;
  for (const double w : weight_of)
    total += w;
  if (!(total > 0)) return false;
  const Fit fit = fitted(samples, weight_of, galerkin_openings);
  rate = fit.row(0).transpose();
  if (galerkin_openings) rate = fitted(directed(samples, fit, weight_of), weight_of, true).row(0).transpose();
  return rate.allFinite();
}

}  // namespace conchoid
