#include "conchoid/sim/prepared_body.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/mesh/carry_attributes.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/sim/body_elements.hpp"
#include "conchoid/sim/initial_cracks.hpp"
#include "conchoid/sim/resolution_floor.hpp"

namespace conchoid {
namespace {

constexpr double kEdgesPerSize = 10;  // default resolution

void move(TriMesh& mesh, const Vec3& shift) {
  for (Vec3& x : mesh.positions)
    x += shift;
}

// Lengths along the boundary of the sheets: the resolution where the scene gives none.
double mean_boundary_edge(const TriMesh& sheet) {
  double sum = 0;
  const std::vector<Edge> edges = boundary_edges(sheet);
  for (const Edge& e : edges)
    sum += (sheet.positions[e.a] - sheet.positions[e.b]).norm() / static_cast<double>(edges.size());
  return sum;
}

double default_crack_edge(const TriMesh& surface, const std::vector<CrackSpec>& cracks) {
  if (!surface.corners.empty()) return std::cbrt(enclosed_volume(surface)) / kEdgesPerSize;
  double size = 0;
  for (const CrackSpec& c : cracks)
    size = std::max({size, c.radius, c.axes.maxCoeff(), 0.5 * c.edge1.norm(), 0.5 * c.edge2.norm()});
  return size / 8;
}

void add_cracks(const Scene& scene, const std::vector<TriMesh>& of_body, PreparedBody& out) {
  const auto add = [&](TriMesh sheet, const std::string& where) {
    move(sheet, -out.origin);
    out.cracks.push_back(out.infinite() ? std::move(sheet) : sheet_in_body(sheet, out.surface, where));
  };
  for (TriMesh sheet :
       of_body) {  // of a piece, whose boundary elements may leave out what a small one lies in
    move(sheet, -out.origin);
    if (std::optional<TriMesh> inside = sheet_if_in_body(sheet, out.surface))
      out.cracks.push_back(std::move(*inside));
    else
      warning(
          fmt::format("a crack of {:.2g} m² that was left in a piece lies outside of its boundary elements "
                      "and ends there",
                      surface_area(sheet)));
  }
  for (const CrackSpec& spec : scene.cracks)
    add(crack_sheet(spec, out.crack_edge), spec.where);
  if (out.infinite() && out.cracks.empty())
    throw InputError(scene.body.where +
                     ": an infinite body without a crack has nothing to compute; add a [[crack]]");
}

// Mean section across the longest extent, or what cracks have from the start.
void require_resolution(const Scene& scene, const PreparedBody& body, double area) {
  const bool of_crack = !scene.resolution.surface;
  if (body.crack_edge > 0)
    require_affordable(scene.resolution.where, "resolution.crack", body.crack_edge, area,
                       most_crack_triangles);
  if (body.surface_edge > 0)
    require_affordable(scene.resolution.where, of_crack ? "resolution.crack / 20" : "resolution.surface",
                       body.surface_edge, area, most_surface_triangles);
}

void require_one_body(const Scene& scene, const TriMesh& surface) {
  const std::vector<int> part = connected_parts(surface);
  std::vector<double> volume(1 + *std::max_element(part.begin(), part.end()), 0.0);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Triangle x = surface.triangle(TriId(t));
    volume[part[surface.corners[TriId(t)][0].index()]] += x[0].dot(cross(x[1], x[2])) / 6;
  }
  const auto bodies = std::count_if(volume.begin(), volume.end(), [](double v) { return v > 0; });
  if (bodies != 1)
    throw InputError(
        fmt::format("{}: the mesh holds {} separate bodies; simulate them one at a time: conchoid "
                    "check FILE --split DIR writes them apart",
                    scene.body.where, bodies));
}

// The file's materials and groups on the boundary elements: those of the nearest triangle of the detailed body.
SurfaceAttributes element_attributes(const Body& body) {
  if (body.attributes.material.empty() && body.attributes.group.empty()) return {};
  const ClosestPointTree detailed(body.detailed);
  std::vector<TriId> nearest;
  for (std::size_t t = 0; t < body.surface.triangle_count(); ++t)
    nearest.push_back(detailed.closest(centroid(body.surface, TriId(t))).triangle);
  return attributes_of(body.attributes, nearest);
}

}  // namespace

Body scene_body(const Scene& scene) {
  BodySettings settings{scene.body.remesh, scene.body.scale, !scene.body.scale_given, scene.run.cache, {}};
  settings.elements.follow_thickness = scene.body.follow_thickness;
  for (const SceneRegion& region : scene.regions)
    if (region.edge)
      settings.elements.limits.push_back(
          {[&rule = region.rule](const Vec3& x) { return rule.holds(x); }, *region.edge});
  return scene.body.model.empty() ? body_from_file(scene.body.mesh, settings)
                                  : body_from_model(scene.body.model, settings);
}

PreparedBody prepare(const Scene& scene, Body body) {
  PreparedBody out;
  if (!body.infinite()) {
    out.regions = scene_regions(scene, body.surface, body.regions, element_attributes(body));
    out.quiet.assign(body.surface.triangle_count(), 0);
    for (const std::string& name : scene.quiet_regions)
      if (const Region* region = find_region(out.regions, name))
        for (TriId t : region->triangles)
          out.quiet[t.index()] = 1;
    out.origin = bounding_box(body.detailed).center();
  }
  out.pieces = body.infinite() ? body.material : frame_of_pieces(body);
  out.surface = std::move(body.surface);
  out.detailed = std::move(body.detailed);
  out.scene_positions = out.detailed.positions;
  out.attributes = std::move(body.attributes);
  move(out.surface, -out.origin);
  move(out.detailed, -out.origin);
  out.material = scene.material;
  out.crack_edge = scene.resolution.crack.value_or(default_crack_edge(out.surface, scene.cracks));
  out.surface_edge = scene.resolution.surface.value_or(out.crack_edge / 20);
  if (!out.infinite()) {
    require_one_body(scene, out.surface);
    const Box box = bounding_box(out.surface);
    require_resolution(scene, out, enclosed_volume(out.surface) / (box.high - box.low).maxCoeff());
  }
  const FieldFrame frame{body.material.turn, body.material.shift, out.pieces.center.value_or(out.origin),
                         out.origin};
  out.toughness = MaterialField(scene.material.toughness_field, frame);
  out.strength = MaterialField(scene.material.strength_field, frame);
  add_cracks(scene, body.cracks, out);
  if (!(out.crack_edge > 0)) out.crack_edge = mean_boundary_edge(out.cracks.front());
  out.surface_edge = scene.resolution.surface.value_or(out.crack_edge / 20);
  if (out.infinite())
    for (const TriMesh& crack : out.cracks)
      require_resolution(scene, out, surface_area(crack));
  // What is wrong with the conditions is said before anything is assembled.
  const LoadCase load = load_of(scene, out);
  std::vector<BoundaryKind> kinds = kinds_of(scene, out);
  choose_elements(scene.run, kinds, out);
  // Of quadratic elements nothing is prescribed any more (as_elements_take).
  out.elastic =
      std::make_shared<const BodyOperator>(out.surface, std::move(kinds), scene.material.elastic(),
                                           BemSettings{scene.run.quadrature_tolerance, scene.run.contact,
                                                       scene.run.solver, scene.run.cache, out.quadratic},
                                           std::span(&load, out.quadratic ? 0 : 1));
  return out;
}

PreparedBody prepare(const Scene& scene) {
  return prepare(scene, scene_body(scene));
}

}  // namespace conchoid
