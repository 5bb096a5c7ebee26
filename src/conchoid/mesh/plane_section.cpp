#include "conchoid/mesh/plane_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <unordered_map>

#include "conchoid/core/vec.hpp"

namespace conchoid {
namespace {

using Loop = std::vector<Vec2>;  // about the point, the body to the left: holes turn clockwise

double signed_area(const Loop& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

bool contains(const Loop& loop, const Vec2& x) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    if (x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double distance_from(const Loop& loop, const Vec2& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& a : loop)
    least = std::min(least, (a - x).norm());
  return least;
}

struct EdgeHash {
  std::size_t operator()(const Edge& e) const {
    return std::hash<std::size_t>{}(e.a.index() * 0x9e3779b97f4a7c15ULL + e.b.index());
  }
};

std::vector<Loop> loops_of(const TriMesh& surface, const Vec3& point, const Vec3& n) {
  const Vec3 along = n.unitOrthogonal(), across = cross(n, along);
  const auto height = [&](NodeId node) { return (surface.positions[node] - point).dot(n); };
  std::unordered_map<Edge, Edge, EdgeHash>
      next;  // edge of the surface that the section crosses → the next one
  std::vector<Edge> order;
  for (const auto& c : surface.corners) {
    std::array<bool, 3> above{};
    for (int k = 0; k < 3; ++k)
      above[k] = height(c[k]) >= 0;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      if (above[l] != above[m] || above[k] == above[l]) continue;
      const Edge to(c[m], c[k]), from(c[k], c[l]);  // k alone on its side
      const Edge& first = above[k] ? from : to;
      next.emplace(first, above[k] ? to : from);
      order.push_back(first);
    }
  }
  const auto place = [&](const Edge& e) {
    const double a = height(e.a), b = height(e.b);
    const Vec3 x =
        surface.positions[e.a] + a / (a - b) * (surface.positions[e.b] - surface.positions[e.a]) - point;
    return Vec2(x.dot(along), x.dot(across));
  };
  std::vector<Loop> loops;
  for (const Edge& start : order) {
    Loop loop;
    for (auto at = next.find(start); at != next.end(); at = next.find(start)) {
      Edge e = start;
      for (auto step = at; step != next.end(); step = next.find(e)) {
        loop.push_back(place(e));
        e = step->second;
        next.erase(step);
      }
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

double section_area(const TriMesh& surface, const Vec3& point, const Vec3& unit_normal) {
  const std::vector<Loop> loops = loops_of(surface, point, unit_normal);
  const Loop* outer = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Loop& loop : loops) {
    if (signed_area(loop) <= 0) continue;
    const double distance = contains(loop, Vec2::Zero()) ? 0 : distance_from(loop, Vec2::Zero());
    if (distance < nearest) {
      nearest = distance;
      outer = &loop;
    }
  }
  if (outer == nullptr) return 0;
  double area = signed_area(*outer);
  for (const Loop& loop : loops)
    if (signed_area(loop) < 0 && contains(*outer, loop[0])) area += signed_area(loop);
  return std::max(area, 0.0);
}

}  // namespace conchoid
