#include "conchoid/sim/frames_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "conchoid/mesh/plane_section.hpp"

namespace conchoid {
namespace {

struct Crack {
  double area = 0;
  Vec3 normal = Vec3::Zero(), center = Vec3::Zero();  // times the area
  int points = 0;
};

int frames_of(const Crack& crack, const TriMesh& surface, double crack_edge) {
  if (!(crack.area > 0) || crack.normal.isZero(0)) return kMostFramesAhead;
  const double left =
      section_area(surface, crack.center / crack.area, crack.normal.normalized()) - crack.area;
  const double frames = left / (crack.points * crack_edge * crack_edge);
  return static_cast<int>(std::clamp(std::ceil(frames), 1.0, double{kMostFramesAhead}));
}

}  // namespace

std::vector<int> frames_ahead(const CrackState& crack, const TriMesh& surface, double crack_edge) {
  std::vector<int> out(crack.points.size(), kMostFramesAhead);
  if (surface.corners.empty()) return out;
  const std::vector<int> part = connected_parts(crack.trimmed);
  std::vector<Crack> cracks(
      part.empty() ? 0 : 1 + static_cast<std::size_t>(*std::max_element(part.begin(), part.end())));
  for (std::size_t t = 0; t < crack.trimmed.triangle_count(); ++t) {
    Crack& c = cracks[static_cast<std::size_t>(part[crack.trimmed.corners[TriId(t)][0].index()])];
    const Vec3 a = area_vector(crack.trimmed, TriId(t));
    c.area += a.norm();
    c.normal += a;
    c.center += a.norm() * centroid(crack.trimmed, TriId(t));
  }
  std::vector<std::optional<std::size_t>> crack_of;  // per point; none outside of the body
  for (const FrontPoint& point : crack.points) {
    const NodeId node = crack.node_in_cut[point.node];
    crack_of.push_back(node.valid() ? std::optional(static_cast<std::size_t>(part[node.index()]))
                                    : std::nullopt);
    if (crack_of.back()) ++cracks[*crack_of.back()].points;
  }
  std::vector<int> frames;
  for (const Crack& c : cracks)
    frames.push_back(c.points > 0 ? frames_of(c, surface, crack_edge) : kMostFramesAhead);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (crack_of[i]) out[i] = frames[*crack_of[i]];
  return out;
}

}  // namespace conchoid
