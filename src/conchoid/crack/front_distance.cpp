#include "conchoid/crack/front_distance.hpp"

#include <algorithm>
#include <limits>

#include "conchoid/crack/front_frames.hpp"

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

FrontFoot foot_on_edge(const TriMesh& crack, const Front& front, std::size_t edge, const Vec3& x) {
  const std::size_t next = next_index(edge, front.nodes.size(), front.closed);
  const Vec3& a = crack.positions[front.nodes[edge]];
  const Vec3& b = crack.positions[front.nodes[next]];
  FrontFoot foot;
  foot.edge = edge;
  foot.fraction = fraction_on_segment(a, b, x);
  const Vec3 on_chord = (1 - foot.fraction) * a + foot.fraction * b;
  foot.distance = (x - on_chord).norm();
  return foot;
}

}  // namespace

FrontFoot closest_foot(const TriMesh& crack, const Front& front, const Vec3& x, std::size_t first_edge,
                       std::size_t reach) {
  const std::size_t n = front.nodes.size(), edges = edge_count(n, front.closed);
  const std::size_t count = std::min(edges, 2 * reach + 1);
  FrontFoot best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t edge = first_edge + k;
    if (front.closed) {
      edge = (edge + edges - reach % edges) % edges;
    } else if (edge < reach || edge - reach >= edges) {
      continue;
    } else {
      edge -= reach;
    }
    const FrontFoot foot = foot_on_edge(crack, front, edge, x);
    if (foot.distance < best.distance) best = foot;
  }
  const std::size_t next = next_index(best.edge, n, front.closed);
  const double length = (crack.positions[front.nodes[next]] - crack.positions[front.nodes[best.edge]]).norm();
  best.distance += sagitta(front.frames[best.edge], front.frames[next], length, best.fraction);
  return best;
}

FrontFrame frame_at(const Front& front, const FrontFoot& foot) {
  const std::size_t next = next_index(foot.edge, front.nodes.size(), front.closed);
  return interpolate(front.frames[foot.edge], front.frames[next], foot.fraction);
}

}  // namespace conchoid
