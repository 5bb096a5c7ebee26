#include "conchoid/mesh/polygon_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/triangulate_polygon.hpp"

namespace conchoid {
namespace {

using Joined = std::function<bool(NodeId, NodeId)>;

/// Twice the area over the squared longest side: triangles below this are flat.
constexpr double flattest = 1e-6;

std::vector<PolygonTriangle> fan(std::size_t corners) {
  std::vector<PolygonTriangle> out;
  for (std::size_t k = 2; k < corners; ++k)
    out.push_back({0, k - 1, k});
  return out;
}

/// The polygon seen along its area vector, counter-clockwise; equal nodes are one.
class Projection {
 public:
  Projection(const IdVector<NodeId, Vec3>& positions, const std::vector<NodeId>& polygon) {
    const Vec3 origin = positions[polygon.front()];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i)
      normal += cross(positions[polygon[i]] - origin, positions[polygon[(i + 1) % polygon.size()]] - origin);
    const double length = normal.norm();
    valid_ = length > 0;
    if (!valid_) return;
    normal /= length;
    Eigen::Index smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    double size = 0;
    for (const NodeId n : polygon)
      size = std::max(size, (positions[n] - origin).norm());
    const Vec3 u = cross(Vec3::Unit(smallest), normal).normalized(), v = cross(normal, u);
    // in the order of ids, which decides between equally good triangulations
    std::map<NodeId, std::size_t> places;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      places.try_emplace(polygon[i], i);
    std::map<NodeId, PlaneIndex> index;
    for (const auto& [node, at] : places) {
      index[node] = static_cast<PlaneIndex>(nodes.at.size());
      const Vec3 x = (positions[node] - origin) / size;
      nodes.at.emplace_back(x.dot(u), x.dot(v));
      place_.push_back(at);
    }
    for (const NodeId n : polygon)
      walk.push_back(index[n]);
    nodes.edges_of.assign(nodes.at.size(), 0);
  }

  bool valid() const { return valid_; }
  std::size_t place(PlaneIndex i) const { return place_[static_cast<std::size_t>(i)]; }
  const Vec2& at(PlaneIndex i) const { return nodes.at[static_cast<std::size_t>(i)]; }
  bool is_proper(PlaneIndex a, PlaneIndex b, PlaneIndex c) const {
    const Vec2 &A = at(a), &B = at(b), &C = at(c);
    const double longest = std::max({(B - A).squaredNorm(), (C - B).squaredNorm(), (A - C).squaredNorm()});
    return plane_area2(A, B, C) > flattest * longest;
  }

  PlaneNodes nodes;
  PlanePolygon walk;

 private:
  bool valid_ = false;
  std::vector<std::size_t> place_;  ///< per plane node: the first place where the walk comes by
};

bool fan_is_right(const Projection& plane, const std::vector<NodeId>& polygon, const Joined& joined) {
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    if (!plane.is_proper(plane.walk[0], plane.walk[k - 1], plane.walk[k])) return false;
    if (k + 1 < polygon.size() && joined && joined(polygon[0], polygon[k])) return false;
  }
  return true;
}

/// None where the polygon covers itself in the projection.
std::optional<std::vector<PolygonTriangle>> best_in_plane(Projection& plane,
                                                          const std::vector<NodeId>& polygon,
                                                          const Joined& joined) {
  const std::size_t n = plane.walk.size();
  for (std::size_t i = 0; i < n; ++i)
    plane.nodes.used.insert(plane_link(plane.walk[i], plane.walk[(i + 1) % n]));
  if (joined)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        if (joined(polygon[i], polygon[j])) plane.nodes.used.insert(plane_link(plane.walk[i], plane.walk[j]));
  std::vector<std::array<PlaneIndex, 3>> found;
  try {
    triangulate_polygon(plane.nodes, plane.walk, found);
  } catch (const ComputationError&) {
    return std::nullopt;
  }
  std::vector<PolygonTriangle> out;
  double area = 0, covered = 0;
  for (const auto& t : found) {
    const double a = plane_area2(plane.at(t[0]), plane.at(t[1]), plane.at(t[2]));
    area += a;
    covered += std::abs(a);
    out.push_back({plane.place(t[0]), plane.place(t[1]), plane.place(t[2])});
  }
  if (covered - area > 1e-9 * covered) return std::nullopt;
  return out;
}

}  // namespace

std::vector<PolygonTriangle> least_area_triangles(const IdVector<NodeId, Vec3>& positions,
                                                  const std::vector<NodeId>& polygon, const Joined& joined) {
  const std::size_t n = polygon.size();
  std::vector<double> least(n * n, 0);  // (i, k): smallest area of a triangulation of the places i … k
  std::vector<std::size_t> middle(n * n, 0);
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t k = i + span;
      least[i * n + k] = std::numeric_limits<double>::infinity();
      if (span + 1 < n && joined && joined(polygon[i], polygon[k])) continue;
      for (std::size_t j = i + 1; j < k; ++j) {
        const double area =
            least[i * n + j] + least[j * n + k] +
            area_vector2(positions[polygon[i]], positions[polygon[j]], positions[polygon[k]]).norm();
        if (area < least[i * n + k]) {
          least[i * n + k] = area;
          middle[i * n + k] = j;
        }
      }
    }
  if (joined && least[n - 1] == std::numeric_limits<double>::infinity())
    return least_area_triangles(positions, polygon, {});
  std::vector<PolygonTriangle> out;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const std::size_t j = middle[i * n + k];
    out.push_back({i, j, k});
    open.push_back({i, j});
    open.push_back({j, k});
  }
  return out;
}

std::vector<PolygonTriangle> polygon_triangles(const IdVector<NodeId, Vec3>& positions,
                                               const std::vector<NodeId>& polygon, const Joined& joined) {
  if (polygon.size() <= 3) return fan(polygon.size());
  Projection plane(positions, polygon);
  if (plane.valid()) {
    if (fan_is_right(plane, polygon, joined)) return fan(polygon.size());
    if (auto best = best_in_plane(plane, polygon, joined)) return *std::move(best);
  }
  return polygon.size() <= longest_for_least_area ? least_area_triangles(positions, polygon, joined)
                                                  : fan(polygon.size());
}

}  // namespace conchoid
