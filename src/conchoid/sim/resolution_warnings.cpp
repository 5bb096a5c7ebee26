#include "conchoid/sim/resolution_warnings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "conchoid/mesh/bores.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/wall_thickness.hpp"
#include "conchoid/remesh/wall_resolution.hpp"
#include "conchoid/sim/body_elements.hpp"

namespace conchoid {
namespace {

constexpr double edges_per_wall = 2, edges_per_radius = 2;
constexpr double rounding = 1.03;  // of the value that is advised, to two digits
constexpr double least_rows = 1.5;
constexpr double least_like = 0.75;   // thickness of the elements over the body's, or its inverse
constexpr double edges_per_part = 3;  // beside a round part's diameter: they leave out a tenth of it

/// @param length  beside which round-off is nothing [m]
std::string place(const Vec3& x, double length) {
  const auto clean = [&](double v) { return std::abs(v) < 1e-9 * length ? 0.0 : v; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", clean(x[0]), clean(x[1]), clean(x[2]));
}

std::vector<std::string> crack_edge_warnings(const PreparedBody& body) {
  std::vector<std::string> out;
  const double edge = body.crack_edge;
  if (const auto wall = thinnest_wall(body.surface, edges_per_wall * edge / rounding))
    out.push_back(fmt::format(
        "resolution.crack = {:.2g} m on a wall of {:.2g} m: a new crack, a disc of that radius, goes "
        "right through, and its fronts have hardly a node inside; use {:.2g} or less to see cracks "
        "grow through the wall",
        edge, *wall, *wall / edges_per_wall));
  const std::vector<Bore> holes = bores(body.surface);
  const auto smallest = std::min_element(holes.begin(), holes.end(),
                                         [](const Bore& a, const Bore& b) { return a.radius < b.radius; });
  if (smallest != holes.end() && edge > rounding * smallest->radius / edges_per_radius)
    out.push_back(fmt::format(
        "resolution.crack = {:.2g} m at a hole of radius {:.2g} m around {}: a new crack reaches beyond "
        "the stress that the hole raises; use {:.2g} or less",
        edge, smallest->radius, place(smallest->center + body.origin, smallest->radius),
        smallest->radius / edges_per_radius));
  return out;
}

/// Largest distance of a node of the crack from its fronts, and the mean edge of these, per connected part.
struct Depth {
  double depth = 0, edges = 0;
  std::size_t count = 0;
  Vec3 at = Vec3::Zero();
};

std::vector<Depth> depths(const CrackState& crack) {
  const std::vector<int> part = connected_parts(crack.trimmed);
  std::vector<Depth> out(
      part.empty() ? 0 : 1 + static_cast<std::size_t>(*std::max_element(part.begin(), part.end())));
  TriMesh lines;
  lines.positions = crack.trimmed.positions;
  for (const Front& front : crack.fronts)
    for (std::size_t i = front.closed ? 0 : 1; i < front.nodes.size(); ++i) {
      const NodeId a = front.nodes[(i + front.nodes.size() - 1) % front.nodes.size()], b = front.nodes[i];
      lines.corners.push_back({a, b, b});
      Depth& of = out[static_cast<std::size_t>(part[b.index()])];
      of.edges += (lines.positions[a] - lines.positions[b]).norm();
      of.at = lines.positions[b];
      ++of.count;
    }
  const ClosestPointTree tree(lines);
  std::vector<char> used(part.size(), 0);
  for (const auto& corners : crack.trimmed.corners)
    for (NodeId n : corners)
      used[n.index()] = 1;
  for (NodeId n(0); n.index() < part.size(); ++n.value) {
    const auto hit = tree.closest(lines.positions[n]);
    if (!used[n.index()] || !hit.triangle.valid()) continue;
    double& depth = out[static_cast<std::size_t>(part[n.index()])].depth;
    depth = std::max(depth, std::sqrt(hit.squared_distance));
  }
  return out;
}

std::vector<std::string> depth_warnings(const PreparedBody& body, const CrackState& crack) {
  std::vector<std::string> out;
  for (const Depth& d : depths(crack)) {
    if (d.count == 0) continue;
    const double edge = d.edges / static_cast<double>(d.count);
    if (d.depth < least_rows * edge)
      out.push_back(fmt::format(
          "the crack at {} is {:.2g} m deep, hardly more than one of its edges of {:.2g} m: its K "
          "is read from a single row of openings and may be a tenth off; use resolution.crack = {:.2g}, or a "
          "mesh of three rows",
          place(d.at + body.origin, edge), d.depth, edge, d.depth / 3));
  }
  return out;
}

std::vector<std::string> quadratic_warnings(const CoarseWalls& walls) {
  const double shown = walls.shown_by_quadratic();
  if (shown >= least_shown) return {};
  return {fmt::format(
      "quadratic elements of {:.2g} m on a wall of {:.2g} m ({:.0f} % of the surface) may show as little as "
      "{:.0f} % of the bending stress; use edges of at most {:.2g} m there",
      walls.edge, walls.thickness, 100 * walls.share, 100 * shown, walls.quadratic_edge)};
}

}  // namespace

std::vector<std::string> element_warnings(const PreparedBody& body) {
  if (body.infinite()) return {};
  const auto walls = coarse_walls(body.surface);
  if (!walls) return {};
  if (body.quadratic) return quadratic_warnings(*walls);
  return {walls->text()};
}

std::optional<std::string> outline_warning(const PreparedBody& body, const Vec3& x) {
  if (body.infinite() || body.same_mesh()) return std::nullopt;
  const double far = bounding_box(body.detailed).diagonal();
  const auto thickness_at = [&](const TriMesh& mesh) {
    const ClosestHit hit = closest_point(mesh, x);
    return wall_thickness(mesh, hit.point, unit_normal(mesh, hit.triangle), far);
  };
  const double elements = thickness_at(body.surface), detailed = thickness_at(body.detailed);
  if (!std::isfinite(elements) || !std::isfinite(detailed) ||
      std::min(elements / detailed, detailed / elements) >= least_like)
    return std::nullopt;
  return fmt::format(
      "the crack at {} starts where the body is {:.2g} m thick and its boundary elements are {:.2g} m: their "
      "stress is not the body's; use a larger body.remesh, or a [[region]] with edge = {:.2g} there",
      place(x + body.origin, detailed), detailed, elements, detailed / edges_per_part);
}

std::vector<std::string> resolution_warnings(const PreparedBody& body, const CrackState& crack,
                                             bool growing) {
  std::vector<std::string> out = element_warnings(body);
  const auto add = [&](std::vector<std::string> more) {
    std::move(more.begin(), more.end(), std::back_inserter(out));
  };
  if (!body.infinite() && (growing || !body.cracks.empty())) add(crack_edge_warnings(body));
  add(depth_warnings(body, crack));
  return out;
}

}  // namespace conchoid
