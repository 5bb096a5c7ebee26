#include "conchoid/crack/intensity/kinks_behind.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

constexpr int kNoRow = kFitRows + 1;

/// Rows as a distance from this front: 0 on it, kNoRow beyond those searched and on other fronts.
std::vector<int> distances(const TriMesh& crack, const Front& front, const std::vector<int>& rows) {
  std::vector<int> out(crack.node_count());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = rows[i] > 0 ? rows[i] : kNoRow;
  for (const NodeId node : front.nodes)
    out[node.index()] = 0;
  return out;
}

/// Area vectors of the triangles around each node: of those between it and the front, and of the others.
struct Sides {
  std::vector<Vec3> ahead, behind;
};

Sides sides_of(const TriMesh& crack, const std::vector<int>& row) {
  Sides out;
  out.ahead.assign(crack.node_count(), Vec3::Zero());
  out.behind = out.ahead;
  for (std::size_t t = 0; t < crack.triangle_count(); ++t) {
    const auto& c = crack.corners[TriId(t)];
    const int last = std::max({row[c[0].index()], row[c[1].index()], row[c[2].index()]});
    if (std::min({row[c[0].index()], row[c[1].index()], row[c[2].index()]}) == kNoRow) continue;
    const Vec3 area = area_vector(crack, TriId(t));
    for (const NodeId node : c)
      (last <= row[node.index()] ? out.ahead : out.behind)[node.index()] += area;
  }
  return out;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(cross(a, b).norm(), a.dot(b));
}

}  // namespace

std::vector<KinkBehind> kinks_behind(const TriMesh& crack, const NodeLinks& links, const Front& front,
                                     const std::vector<int>& rows) {
  const std::vector<int> row = distances(crack, front, rows);
  const Sides sides = sides_of(crack, row);
  std::vector<KinkBehind> out(crack.node_count());
  std::vector<Vec3> normal(crack.node_count(), Vec3::Zero()), along = normal;  // of the front before the node
  for (std::size_t i = 0; i < front.nodes.size(); ++i) {
    normal[front.nodes[i].index()] = front.frames[i].e1;
    along[front.nodes[i].index()] = front.frames[i].e3;
  }
  std::vector<std::vector<NodeId>> layers(kNoRow);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (rows[i] > 0) layers[static_cast<std::size_t>(rows[i])].push_back(NodeId(i));
  for (const auto& layer : layers)
    for (const NodeId node : layer) {
      const std::size_t n = node.index();
      double turn = std::numbers::pi;
      for (const NodeId* to = links.begin(node); to != links.end(node); ++to) {
        if (row[to->index()] != row[n] - 1) continue;
        turn = std::min(turn, out[to->index()].turn);
        normal[n] += normal[to->index()];
        along[n] += along[to->index()];
      }
      const Vec3 &ahead = sides.ahead[n], &behind = sides.behind[n];
      out[n].turn = std::max(turn, angle_between(normal[n], ahead));
      const double unsigned_kink = angle_between(behind, ahead);
      const double about = -cross(behind, ahead).dot(along[n]);
      const double bound = cross(behind, ahead).norm() * along[n].norm();
      out[n].kink = bound > 0 ? unsigned_kink * about / bound : 0;
    }
  return out;
}

double share_behind_turn(double turn) {
  return std::clamp(2 - turn / kSmoothSurfaceTurn, 0.0, 1.0);
}

Vec3 without_kink(const Vec3& rate, double kink) {
  const double sharp = 1 - share_behind_turn(std::abs(kink));
  if (!(sharp > 0)) return rate;
  const double a = sharp * std::clamp(kink, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  const double m11 = 1 + kKinkRates[0] * a * a * a * a, m12 = -kKinkRates[1] * a * a * a;
  const double m21 = -kKinkRates[2] * a * a * a, m22 = 1 + kKinkRates[3] * a * a;
  const double m33 = 1 / std::sqrt(1 - a * a / (std::numbers::pi * std::numbers::pi));
  const double determinant = m11 * m22 - m12 * m21;
  return {(m22 * rate[0] - m12 * rate[1]) / determinant, (m11 * rate[1] - m21 * rate[0]) / determinant,
          rate[2] / m33};
}

}  // namespace conchoid
