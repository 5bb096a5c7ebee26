#include "conchoid/sim/initial_cracks.hpp"

#include <algorithm>
#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/remesh/validate.hpp"

namespace conchoid {
namespace {

constexpr double kOnSurface = 1e-3;  // of a crack edge: nearer than this to the surface lies on it
constexpr double kStickOut = 0.35;   // of a crack edge: how far a sheet that ends on the surface is drawn out
constexpr double kClearOf =
    0.2;                        // of a crack edge: how far other nodes that lie in the surface go out of it,
                                // beyond kMouthMerge
constexpr double kAlong = 0.2;  // sine between sheet and face: below it the sheet runs along the face

// Moves the nodes of the given boundary edges outward, in the plane of the sheet.
TriMesh draw_out(TriMesh sheet, const std::vector<Edge>& edges, double length) {
  const TriMesh extended = extend_sheet_beyond(sheet, edges, length);
  const std::size_t own = sheet.node_count();
  std::vector<double> nearest(own, std::numeric_limits<double>::infinity());
  for (std::size_t t = sheet.triangle_count(); t < extended.triangle_count(); ++t)
    for (NodeId from : extended.corners[TriId(t)])
      for (NodeId to : extended.corners[TriId(t)]) {
        if (from.index() >= own || to.index() < own) continue;
        const double distance = (extended.positions[to] - extended.positions[from]).norm();
        if (distance >= nearest[from.index()]) continue;
        nearest[from.index()] = distance;
        sheet.positions[from] = extended.positions[to];
      }
  return sheet;
}

// Mean edge of the triangles around each node.
IdVector<NodeId, double> edges_at_nodes(const TriMesh& sheet) {
  IdVector<NodeId, double> sum(sheet.node_count(), 0.0), count(sheet.node_count(), 0.0);
  for (const auto& c : sheet.corners)
    for (int k = 0; k < 3; ++k)
      for (const NodeId n : {c[k], c[(k + 1) % 3]}) {
        sum[n] += (sheet.positions[c[(k + 1) % 3]] - sheet.positions[c[k]]).norm();
        ++count[n];
      }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[NodeId(i)] > 0) sum[NodeId(i)] /= count[NodeId(i)];
  return sum;
}

// Ways out of the body within the sheet, one across each face of the surface nearer to x than `near`.
std::vector<Vec3> ways_out(const TriMesh& surface, const BoxTree& tree, const Vec3& x, const Vec3& normal,
                           double near) {
  std::vector<Vec3> ways;
  const Box around{x - near * Vec3::Ones(), x + near * Vec3::Ones()};
  for (const TriId t : tree.overlapping(around)) {
    if ((closest_point_on_triangle(surface.triangle(t), x) - x).norm() > near) continue;
    const Vec3 outward = area_vector(surface, t).normalized();
    const Vec3 within = outward - outward.dot(normal) * normal;
    if (!(within.norm() > kAlong)) continue;
    const Vec3 way = within.normalized();
    const auto same = [&](const Vec3& w) { return w.dot(way) > 1 - kOnSurface; };
    if (std::none_of(ways.begin(), ways.end(), same)) ways.push_back(way);
  }
  return ways;
}

// Where the sheet runs on beyond the surface and has nodes in it, as a disc about a point of a face has, these
// go out of the body, across all faces that they lie in: a node in the surface leaves triangles without area.
TriMesh clear_of_surface(TriMesh sheet, const TriMesh& surface) {
  const BoxTree tree(surface);
  const IdVector<NodeId, Vec3> normals = unit_node_normals(sheet);
  const IdVector<NodeId, double> edges = edges_at_nodes(sheet);
  for (std::size_t i = 0; i < sheet.node_count(); ++i) {
    const NodeId node(i);
    const auto ways = ways_out(surface, tree, sheet.positions[node], normals[node], kOnSurface * edges[node]);
    if (ways.empty()) continue;
    Vec3 sum = Vec3::Zero();
    for (const Vec3& way : ways)
      sum += way;
    double least = sum.norm();  // of what it gains across each face
    for (const Vec3& way : ways)
      least = std::min(least, sum.dot(way));
    const double gain = std::max(least, 0.5 * sum.norm());
    if (gain > 0) sheet.positions[node] += kClearOf * edges[node] / gain * sum;
  }
  return sheet;
}

TriMesh stick_out(const TriMesh& sheet, const ClosestPointTree& surface) {
  std::vector<Edge> mouth;
  double length = 0;
  for (const Edge& e : boundary_edges(sheet)) {
    const Vec3 &a = sheet.positions[e.a], &b = sheet.positions[e.b];
    const double edge = (a - b).norm(), near = kOnSurface * edge;
    const auto on = [&](const Vec3& x) { return surface.closest(x).squared_distance <= near * near; };
    if (!on(a) || !on(b) || !on(0.5 * (a + b))) continue;
    mouth.push_back(e);
    length += edge;
  }
  if (mouth.empty()) return sheet;
  return draw_out(sheet, mouth, kStickOut * length / static_cast<double>(mouth.size()));
}

}  // namespace

TriMesh crack_sheet(const CrackSpec& spec, double edge) {
  SheetResolution resolution;
  if (spec.triangles)
    resolution.triangles = *spec.triangles;
  else
    resolution.edge = edge;
  switch (spec.kind) {
    case CrackKind::disc:
      return disc_crack(spec.center, spec.normal, spec.radius, resolution, spec.direction);
    case CrackKind::ellipse:
      return ellipse_crack(spec.center, spec.normal, spec.axes[0], spec.axes[1], resolution, spec.direction);
    case CrackKind::rectangle:
      return rectangle_crack(spec.center, spec.edge1, spec.edge2, resolution);
    case CrackKind::mesh:
      break;
  }
  TriMesh sheet = read_mesh(spec.file);
  require_valid_sheet(sheet, spec.file.string());
  return sheet;
}

std::optional<TriMesh> sheet_if_in_body(const TriMesh& sheet, const TriMesh& surface) {
  TriMesh out = clear_of_surface(stick_out(sheet, ClosestPointTree(surface)), surface);
  if (corefine(surface, out).sheet.empty()) return std::nullopt;
  return out;
}

TriMesh sheet_in_body(const TriMesh& sheet, const TriMesh& surface, const std::string& where) {
  std::optional<TriMesh> out = sheet_if_in_body(sheet, surface);
  if (!out)
    throw InputError(
        where +
        ": the crack lies outside of the body; give it a place inside, in the body's coordinates "
        "(body.scale changes the body, not the crack)");
  return std::move(*out);
}

}  // namespace conchoid
