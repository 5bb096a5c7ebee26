#include "conchoid/crack/intensity/front_distance.hpp"

#include <algorithm>
#include <limits>

#include "conchoid/crack/front/front_frames.hpp"

namespace conchoid {

namespace {

double fraction_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  return length2 > 0 ? std::clamp(along.dot(x - a) / length2, 0.0, 1.0) : 0.0;
}

/// How far the true front lies outside the chord, at a fraction s of it. Positive where the crack is convex.
double sagitta(const FrontFrame& a, const FrontFrame& b, double length, double s) {
  const Vec3 forward = 0.5 * (a.e2 + b.e2);
  const double turn = -(b.e3 - a.e3).dot(forward);  // curvature times length
  return 0.5 * turn * length * s * (1 - s);
}

/// Foot of x on one front edge: where x lies in the plane across the interpolated tangent, so that feet move
/// smoothly from edge to edge. Where no point of the edge has x abreast (beyond open ends, behind sharp
/// corners) the closest point of the chord.
struct EdgeFoot {
  double fraction = 0;
  double distance = 0;
  bool abreast = false;
};

EdgeFoot foot_on_edge(const TriMesh& crack, const Front& front, std::size_t edge, const Vec3& x) {
  const std::size_t next = next_index(edge, front.nodes.size(), front.closed);
  const Vec3& a = crack.positions[front.nodes[edge]];
  const Vec3& b = crack.positions[front.nodes[next]];
  const auto ahead = [&](double s) {
    return (x - (1 - s) * a - s * b).dot((1 - s) * front.frames[edge].e3 + s * front.frames[next].e3);
  };
  EdgeFoot foot;
  foot.abreast = ahead(0) >= 0 && ahead(1) <= 0;
  if (foot.abreast) {
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
      const double s = 0.5 * (low + high);
      (ahead(s) >= 0 ? low : high) = s;
    }
    foot.fraction = 0.5 * (low + high);
  } else {
    foot.fraction = fraction_on_segment(a, b, x);
  }
  foot.distance = (x - (1 - foot.fraction) * a - foot.fraction * b).norm();
  return foot;
}

}  // namespace

FrontFoot closest_foot(const TriMesh& crack, const Front& front, const Vec3& x, EdgeRange range) {
  const std::size_t n = front.nodes.size();
  const auto edges = static_cast<std::ptrdiff_t>(edge_count(n, front.closed));
  const auto wanted = static_cast<std::ptrdiff_t>(range.count);
  const auto count = front.closed ? std::min(edges, wanted) : wanted;
  EdgeFoot best;
  best.distance = std::numeric_limits<double>::infinity();
  std::size_t best_edge = 0;
  bool clipped = false;
  for (std::ptrdiff_t k = range.first; k < range.first + count; ++k) {
    if (!front.closed && (k < 0 || k >= edges)) continue;
    const auto edge = static_cast<std::size_t>((k % edges + edges) % edges);
    const EdgeFoot foot = foot_on_edge(crack, front, edge, x);
    if (foot.abreast != best.abreast ? foot.abreast : foot.distance < best.distance) {
      best = foot;
      best_edge = edge;
      const bool goes_on_before = front.closed ? count < edges : k > 0;
      const bool goes_on_after = front.closed ? count < edges : k + 1 < edges;
      clipped = !foot.abreast && ((k == range.first && foot.fraction == 0 && goes_on_before) ||
                                  (k + 1 == range.first + count && foot.fraction == 1 && goes_on_after));
    }
  }
  const std::size_t next = next_index(best_edge, n, front.closed);
  const double length = (crack.positions[front.nodes[next]] - crack.positions[front.nodes[best_edge]]).norm();
  const double outside = sagitta(front.frames[best_edge], front.frames[next], length, best.fraction);
  return {best_edge, best.fraction, best.distance + outside, clipped};
}

FrontFrame frame_at(const Front& front, const FrontFoot& foot) {
  const std::size_t next = next_index(foot.edge, front.nodes.size(), front.closed);
  return interpolate(front.frames[foot.edge], front.frames[next], foot.fraction);
}

}  // namespace conchoid
