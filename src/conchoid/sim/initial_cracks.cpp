#include "conchoid/sim/initial_cracks.hpp"

#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/remesh/validate.hpp"

namespace conchoid {
namespace {

constexpr double kOnSurface = 1e-3;  // of a crack edge: nearer than this to the surface lies on it
constexpr double kStickOut = 0.35;   // of a crack edge: how far a sheet that ends on the surface is drawn out

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

TriMesh sheet_in_body(const TriMesh& sheet, const TriMesh& surface, const std::string& where) {
  TriMesh out = stick_out(sheet, ClosestPointTree(surface));
  if (corefine(surface, out).sheet.empty())
    throw InputError(
        where +
        ": the crack lies outside of the body; give it a place inside, in the body's coordinates "
        "(body.scale changes the body, not the crack)");
  return out;
}

}  // namespace conchoid
