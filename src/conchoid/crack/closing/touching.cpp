#include "conchoid/crack/closing/touching.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/length_factors.hpp"
#include "conchoid/mesh/box_tree.hpp"

namespace conchoid {

namespace {

/// A front node, where it goes, and its forward direction.
struct Mover {
  NodeId node;
  Vec3 from, to, forward, normal;
  bool moves = false;
  FrontState state = FrontState::active;
};

struct MovingFront {
  std::vector<Mover> nodes;
  bool closed = false;
};

std::vector<MovingFront> moving_fronts(const CrackSheet& sheet, const std::vector<FrontMotion>& motions) {
  std::vector<FrontMotion> sorted = motions;
  std::sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) { return x.node < y.node; });
  const auto normals = node_area_vectors(sheet.mesh);
  std::vector<MovingFront> fronts;
  for (const SheetFront& front : sheet.fronts) {
    MovingFront& moving = fronts.emplace_back();
    moving.closed = front.closed;
    const auto frames = front_frames(sheet.mesh, normals, front.nodes, front.closed);
    for (std::size_t i = 0; i < front.nodes.size(); ++i) {
      const Vec3& x = sheet.mesh.positions[front.nodes[i]];
      const auto at = std::lower_bound(sorted.begin(), sorted.end(), front.nodes[i],
                                       [](const FrontMotion& m, NodeId n) { return m.node < n; });
      const bool moves = at != sorted.end() && at->node == front.nodes[i];
      moving.nodes.push_back({front.nodes[i], x, moves ? Vec3(x + at->displacement) : x, frames[i].e2,
                              frames[i].e1, moves, sheet.state[front.nodes[i]]});
    }
  }
  return fronts;
}

bool neighbours_on_front(std::size_t i, std::size_t edge, std::size_t n, bool closed) {
  const auto apart = [&](std::size_t a, std::size_t b) {
    const std::size_t d = a > b ? a - b : b - a;
    return closed ? std::min(d, n - d) : d;
  };
  return std::min(apart(i, edge), apart(i, next_index(edge, n, closed))) < kNeighbourEdges;
}

/// A ring about to close (sheet.hpp) touches itself by intent.
bool closes(const MovingFront& front, double target_edge) {
  if (!front.closed) return false;
  Vec3 center = Vec3::Zero();
  for (const Mover& m : front.nodes)
    center += m.to / static_cast<double>(front.nodes.size());
  return std::all_of(front.nodes.begin(), front.nodes.end(), [&](const Mover& m) {
    return m.moves && (m.to - center).norm() < kClosingRadius * target_edge;
  });
}

bool touches(const Mover& m, const Mover& a, const Mover& b, bool one_front, double target_edge) {
  double distance = kTouchDistance * target_edge;
  if (std::min(m.normal.dot(a.normal), m.normal.dot(b.normal)) > kSameSide) {
    const Vec3 normal = (2 * m.normal + a.normal + b.normal).normalized();
    const double across = std::abs((0.5 * (a.from + b.from) - m.from).dot(normal));
    if (!one_front && across > kPassingOffset * target_edge) return false;
    distance = (one_front ? kMeetOneFront : kMeetDistance) * target_edge;
  }
  const Vec3 other_forward = a.forward + b.forward;
  const Vec3 step = m.to - m.from;
  if (m.forward.dot(other_forward) >= 0) return false;
  if ((0.5 * (a.from + b.from) - m.from).dot(step) <= 0) return false;
  return std::min(segment_distance(m.from, m.to, a.to, b.to),
                  segment_distance(m.from, m.to, a.from, b.from)) < distance;
}

/// From place `edge` of a front to the next.
struct FrontEdge {
  std::size_t front, edge, next;
};

/// The edges of all fronts, in their order, by where they are on their way.
class FrontEdges {
 public:
  explicit FrontEdges(const std::vector<MovingFront>& fronts)
      : edges_(edges_of(fronts)), tree_(boxes_of(fronts, edges_)) {}
  /// All that come nearer to the node on its way than that, and others; in their order.
  std::vector<FrontEdge> near(const Mover& m, double distance) const {
    const Vec3 reach = Vec3::Constant(distance * (1 + kRoundOff));
    std::vector<FrontEdge> found;
    for (const TriId e : tree_.overlapping({m.from.cwiseMin(m.to) - reach, m.from.cwiseMax(m.to) + reach}))
      found.push_back(edges_[e.index()]);
    return found;
  }

 private:
  static std::vector<FrontEdge> edges_of(const std::vector<MovingFront>& fronts) {
    std::vector<FrontEdge> edges;
    for (std::size_t f = 0; f < fronts.size(); ++f) {
      const std::size_t n = fronts[f].nodes.size();
      for (std::size_t e = 0; e < edge_count(n, fronts[f].closed); ++e)
        edges.push_back({f, e, next_index(e, n, fronts[f].closed)});
    }
    return edges;
  }
  static std::vector<Box> boxes_of(const std::vector<MovingFront>& fronts,
                                   const std::vector<FrontEdge>& edges) {
    std::vector<Box> boxes;
    for (const FrontEdge& e : edges) {
      const Mover &a = fronts[e.front].nodes[e.edge], &b = fronts[e.front].nodes[e.next];
      boxes.push_back({a.from.cwiseMin(a.to).cwiseMin(b.from).cwiseMin(b.to),
                       a.from.cwiseMax(a.to).cwiseMax(b.from).cwiseMax(b.to)});
    }
    return boxes;
  }

  std::vector<FrontEdge> edges_;
  BoxTree tree_;
};

}  // namespace

double segment_distance(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const Vec3 u = q - p, v = b - a, w = p - a;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-14 * uu * vv ? std::clamp((uv * vw - uw * vv) / det, 0.0, 1.0) : 0.0;
  double t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
  t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
  return (w + s * u - t * v).norm();
}

std::vector<FrontTouch> front_touches(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                      double target_edge) {
  const auto fronts = moving_fronts(sheet, motions);
  const FrontEdges edges(fronts);
  constexpr double farthest = std::max({kTouchDistance, kMeetDistance, kMeetOneFront});
  std::vector<FrontTouch> touches_found;
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const bool closing = closes(fronts[f], target_edge);
    for (std::size_t i = 0; i < fronts[f].nodes.size(); ++i) {
      const Mover& m = fronts[f].nodes[i];
      if (!m.moves || m.state == FrontState::arrested) continue;
      for (const auto& [g, e, next] : edges.near(m, farthest * target_edge)) {
        if (f == g && closing) continue;
        const Mover &a = fronts[g].nodes[e], &b = fronts[g].nodes[next];
        // Only within a hole do they matter to each other: two ends of a front that come round it.
        if (a.state == FrontState::outside && b.state == FrontState::outside &&
            m.state != FrontState::outside)
          continue;
        if (f == g && neighbours_on_front(i, e, fronts[g].nodes.size(), fronts[g].closed)) continue;
        if (touches(m, a, b, f == g, target_edge))
          touches_found.push_back({f, i, g, e, segment_distance(m.from, m.from, a.from, b.from)});
      }
    }
  }
  return touches_found;
}

std::vector<NodeId> touching_nodes(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                   double target_edge) {
  std::vector<NodeId> touching;
  const auto take = [&](const SheetFront& front, std::size_t i) {
    if (sheet.state[front.nodes[i]] == FrontState::active) touching.push_back(front.nodes[i]);
  };
  for (const FrontTouch& touch : front_touches(sheet, motions, target_edge)) {
    const SheetFront& other = sheet.fronts[touch.other];
    take(sheet.fronts[touch.front], touch.index);
    take(other, touch.edge);
    take(other, next_index(touch.edge, other.nodes.size(), other.closed));
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

}  // namespace conchoid
