#include "conchoid/mesh/plane_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/within.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "conchoid/core/vec.hpp"

namespace conchoid {
namespace {

using Point = boost::geometry::model::d2::point_xy<double>;
// About the point that is asked for, counter-clockwise and open: the body to the left, so holes have negative areas.
using Loop = boost::geometry::model::ring<Point, false, false>;
using boost::geometry::area, boost::geometry::within;

double distance_from(const Loop& loop) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& a : loop)
    least = std::min(least, std::hypot(a.x(), a.y()));
  return least;
}

std::vector<Loop> loops_of(const TriMesh& surface, const Vec3& point, const Vec3& n) {
  const Vec3 along = n.unitOrthogonal(), across = cross(n, along);
  const auto height = [&](NodeId node) { return (surface.positions[node] - point).dot(n); };
  std::map<Edge, Edge> next;  // edge of the surface that the section crosses → the next one
  for (const auto& c : surface.corners) {
    std::array<bool, 3> above{};
    for (int k = 0; k < 3; ++k)
      above[k] = height(c[k]) >= 0;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      if (above[l] != above[m] || above[k] == above[l]) continue;
      const Edge before(c[k], c[l]), after(c[m], c[k]);  // k alone on its side
      next.emplace(above[k] ? before : after, above[k] ? after : before);
    }
  }
  const auto place = [&](const Edge& e) {
    const double a = height(e.a), b = height(e.b);
    const Vec3 x =
        surface.positions[e.a] + a / (a - b) * (surface.positions[e.b] - surface.positions[e.a]) - point;
    return Point(x.dot(along), x.dot(across));
  };
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop& loop = loops.emplace_back();
    Edge e = next.begin()->first;
    for (auto step = next.find(e); step != next.end(); step = next.find(e)) {
      loop.push_back(place(e));
      e = step->second;
      next.erase(step);
    }
  }
  return loops;
}

}  // namespace

double section_area(const TriMesh& surface, const Vec3& point, const Vec3& unit_normal) {
  const std::vector<Loop> loops = loops_of(surface, point, unit_normal);
  const Loop* outer = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Loop& loop : loops) {
    if (area(loop) <= 0) continue;
    const double distance = within(Point(0, 0), loop) ? 0 : distance_from(loop);
    if (distance < nearest) {
      nearest = distance;
      outer = &loop;
    }
  }
  if (outer == nullptr) return 0;
  double sum = area(*outer);
  for (const Loop& loop : loops)
    if (area(loop) < 0 && within(loop[0], *outer)) sum += area(loop);
  return std::max(sum, 0.0);
}

}  // namespace conchoid
