#include "conchoid/crack/front/strip_runs.hpp"

#include <algorithm>
#include <numeric>

namespace conchoid {

StripRuns::StripRuns(const TriMesh& mesh, const StripCurve& curve, const std::vector<Vec3>& target,
                     const std::vector<bool>& moved, const StripSettings& settings)
    : mesh_(mesh),
      curve_(curve),
      target_(target),
      moved_(moved),
      settings_(settings),
      run_(curve.nodes.size()) {
  std::iota(run_.begin(), run_.end(), std::size_t{0});
  members_.assign(run_.size(), 1);
  position_ = target;
  pinned_.assign(run_.size(), false);
  for (std::size_t i = 0; i < curve.pinned.size(); ++i)
    pinned_[i] = curve.pinned[i];
  if (closes())
    merge_all();
  else
    merge_short_edges();
}

bool StripRuns::shrinks() const {
  double before = 0, after = 0;
  for (std::size_t i = 0; i < edges(); ++i) {
    before += (mesh_.positions[curve_.nodes[next(i)]] - mesh_.positions[curve_.nodes[i]]).norm();
    after += (target_[next(i)] - target_[i]).norm();
  }
  return after < before;
}

bool StripRuns::closes() const {
  const std::size_t n = run_.size();
  if (!curve_.closed || n < 3 || std::find(moved_.begin(), moved_.end(), false) != moved_.end()) return false;
  Vec3 center = Vec3::Zero();
  for (const Vec3& x : target_)
    center += x / static_cast<double>(n);
  for (const Vec3& x : target_)
    if ((x - center).norm() >= settings_.close_below) return false;
  return shrinks();
}

void StripRuns::merge_all() {
  Vec3 center = Vec3::Zero();
  for (const Vec3& x : target_)
    center += x / static_cast<double>(run_.size());
  std::fill(run_.begin(), run_.end(), std::size_t{0});
  members_[0] = run_.size();
  position_[0] = center;
}

/// Edges in order of their ids, so that neither round-off nor the direction of the walk decides which goes
/// first.
void StripRuns::merge_short_edges() {
  std::vector<std::size_t> order(edges());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return Edge(curve_.nodes[x], curve_.nodes[next(x)]) < Edge(curve_.nodes[y], curve_.nodes[next(y)]);
  });
  std::size_t left = run_.size();
  for (std::size_t i : order) {
    const std::size_t j = next(i);
    if (!moved_[i] || !moved_[j] || run_[i] == run_[j] || (curve_.closed && left <= 3)) continue;
    if (pinned_[run_[i]] && pinned_[run_[j]]) continue;
    if (!too_short(i, j)) continue;
    merge(run_[i], run_[j]);
    --left;
  }
}

bool StripRuns::too_short(std::size_t i, std::size_t j) const {
  const Vec3 edge = position(j) - position(i);
  const Vec3 old = mesh_.positions[curve_.nodes[j]] - mesh_.positions[curve_.nodes[i]];
  return edge.norm() < settings_.collapse_below || edge.dot(old) <= 0;
}

void StripRuns::merge(std::size_t a, std::size_t b) {
  const auto wa = static_cast<double>(members_[a]), wb = static_cast<double>(members_[b]);
  Vec3 x = (wa * position_[a] + wb * position_[b]) / (wa + wb);
  if (pinned_[a]) x = position_[a];
  if (pinned_[b]) x = position_[b];
  const std::size_t keep = std::min(a, b), drop = std::max(a, b);
  for (std::size_t& r : run_)
    if (r == drop) r = keep;
  members_[keep] += members_[drop];
  pinned_[keep] = pinned_[a] || pinned_[b];
  position_[keep] = x;
}

}  // namespace conchoid
