#include "conchoid/sim/body_setup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/validate.hpp"

namespace conchoid {
namespace {

constexpr double kOnSurface = 1e-3;  // of a crack edge: nearer than this to the surface lies on it
constexpr double kStickOut =
    0.35;  // of a crack edge: how far a sheet that ends on the surface is drawn out beyond it
constexpr double kEdgesPerSize = 10;  // default resolution

void scale_and_move(TriMesh& mesh, double scale, const Vec3& origin) {
  for (Vec3& x : mesh.positions)
    x = scale * x - origin;
}

struct SceneBody {
  TriMesh surface, detailed;
  SurfaceAttributes attributes;
  BodyModel model;
};

// A remeshed triangle takes the region of the triangle of the model that its centre is nearest to.
std::vector<Region> regions_after_remeshing(const SceneBody& body) {
  std::vector<Region> regions = body.model.regions;
  if (regions.empty()) return regions;
  const IdVector<TriId, int> region_of = region_of_triangles(body.detailed, regions);
  for (Region& r : regions)
    r.triangles.clear();
  const ClosestPointTree tree(body.detailed);
  for (std::size_t t = 0; t < body.surface.triangle_count(); ++t) {
    const int region = region_of[tree.closest(centroid(body.surface, TriId(t))).triangle];
    if (region >= 0) regions[region].triangles.push_back(TriId(t));
  }
  return regions;
}

SceneBody load_body(const Scene& scene) {
  SceneBody out;
  const BodySpec& spec = scene.body;
  if (!spec.model.empty()) {
    out.model = built_in_model(spec.model);
    out.detailed = out.model.mesh;
  } else {
    AttributedMesh read = read_surface(spec.mesh);
    out.detailed = std::move(read.mesh);
    out.attributes = std::move(read.attributes);
    require_valid_body(out.detailed, spec.mesh.string());
  }
  for (TriMesh* mesh : {&out.detailed, &out.model.crack})
    scale_and_move(*mesh, spec.scale, Vec3::Zero());
  out.surface = out.detailed;
  if (spec.remesh && !spec.infinite()) {
    out.surface = remesh(out.detailed, *spec.remesh);
    out.model.regions = regions_after_remeshing(out);
  }
  return out;
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

TriMesh make_crack(const CrackSpec& spec, double edge) {
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

// Boundary edges that lie on the surface are the mouth: the sheet's nodes there are drawn out beyond it, so
// that it cuts the surface cleanly and none of its nodes lies in the surface.
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

void add_cracks(const Scene& scene, const TriMesh& model_crack, BodySetup& out) {
  const ClosestPointTree tree(out.surface);
  const auto add = [&](TriMesh sheet, const std::string& where) {
    scale_and_move(sheet, 1, out.origin);
    if (!out.infinite()) {
      sheet = stick_out(sheet, tree);
      if (corefine(out.surface, sheet).sheet.empty())
        throw InputError(
            where +
            ": the crack lies outside of the body; give it a place inside, in the body's coordinates "
            "(body.scale changes the body, not the crack)");
    }
    out.cracks.push_back(std::move(sheet));
  };
  if (!model_crack.corners.empty()) add(model_crack, scene.body.where);
  for (const CrackSpec& spec : scene.cracks)
    add(make_crack(spec, out.crack_edge), spec.where);
  if (out.infinite() && out.cracks.empty())
    throw InputError(scene.body.where +
                     ": an infinite body without a crack has nothing to compute; add a [[crack]]");
}

double region_area(const TriMesh& surface, const Region& region) {
  double area = 0;
  for (TriId t : region.triangles)
    area += area_vector(surface, t).norm();
  return area;
}

void apply_conditions(const Scene& scene, BodySetup& out) {
  std::vector<int> setter(out.surface.node_count(), -1);  // displacement condition that holds a node
  for (std::size_t b = 0; b < scene.boundary.size(); ++b) {
    const BoundaryCondition& condition = scene.boundary[b];
    const Region* region = find_region(out.regions, condition.region);
    if (!region || region->triangles.empty())
      throw InputError(fmt::format("{}: region '{}' has no triangles; widen its half spaces", condition.where,
                                   condition.region));
    for (TriId t : region->triangles) {
      if (condition.kind == ConditionKind::displacement) {
        out.data.kind[t.index()] = BoundaryKind::displacement;
        for (NodeId node : out.surface.corners[t]) {
          int& by = setter[node.index()];
          if (by >= 0 && out.data.displacement[node] != condition.value)
            throw InputError(
                fmt::format("{}: contradicts the condition at {}: regions '{}' and '{}' share node {} but "
                            "displace it differently; "
                            "leave a strip of free surface between them",
                            condition.where, scene.boundary[by].where, condition.region,
                            scene.boundary[by].region, node.value));
          by = static_cast<int>(b);
          out.data.displacement[node] = condition.value;
        }
      } else {
        out.data.traction[t.index()] = condition.kind == ConditionKind::traction
                                           ? condition.value
                                           : Vec3(condition.value / region_area(out.surface, *region));
      }
    }
  }
}

void balance(const Scene& scene, BodySetup& out) {
  if (!out.data.pure_traction()) return;
  const Resultant r = resultant(out.surface, out.data);
  if (balanced(r, out.surface)) return;
  const std::string where = scene.boundary.empty() ? scene.file : scene.boundary.front().where;
  if (!scene.run.inertia_relief)
    throw InputError(
        fmt::format("{}: the loads are out of balance (force {:.3g} {:.3g} {:.3g} N, moment {:.3g} {:.3g} "
                    "{:.3g} N m) and nothing is held: "
                    "fix a region, balance them, or set run.inertia_relief = true",
                    where, r.force.x(), r.force.y(), r.force.z(), r.moment.x(), r.moment.y(), r.moment.z()));
  out.ambient = inertia_field(out.surface, r, scene.material.elastic());
  for (std::size_t t = 0; t < out.surface.triangle_count(); ++t) {
    const auto& c = out.surface.corners[TriId(t)];
    const Vec3 n = unit_normal(out.surface, TriId(t));
    for (int k = 0; k < 3; ++k)  // mean over the triangle, exact for the field's quadratic stress
      out.data.traction[t] -=
          out.ambient.stress(0.5 * (out.surface.positions[c[k]] + out.surface.positions[c[(k + 1) % 3]])) *
          n / 3;
  }
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
    throw InputError(fmt::format("{}: the mesh holds {} separate bodies; simulate them one at a time",
                                 scene.body.where, bodies));
}

}  // namespace

BodySetup set_up_body(const Scene& scene) {
  SceneBody body = load_body(scene);
  BodySetup out;
  if (!scene.body.infinite()) {
    out.regions = scene_regions(scene, body.surface, body.model.regions);
    out.origin = bounding_box(body.detailed).center();
  }
  out.surface = std::move(body.surface);
  out.detailed = std::move(body.detailed);
  out.scene_positions = out.detailed.positions;
  out.attributes = std::move(body.attributes);
  scale_and_move(out.surface, 1, out.origin);
  scale_and_move(out.detailed, 1, out.origin);
  out.data = free_surface(out.surface);
  out.crack_edge = scene.resolution.crack.value_or(default_crack_edge(out.surface, scene.cracks));
  if (!out.infinite()) {
    require_one_body(scene, out.surface);
    apply_conditions(scene, out);
    balance(scene, out);
  } else {
    out.ambient =
        uniform_stress(scene.remote_stress, scene.material.youngs_modulus, scene.material.poisson_ratio);
  }
  out.toughness = MaterialField(scene.material.toughness_field, out.origin);
  out.strength = MaterialField(scene.material.strength_field, out.origin);
  add_cracks(scene, body.model.crack, out);
  if (!(out.crack_edge > 0)) out.crack_edge = mean_boundary_edge(out.cracks.front());
  out.surface_edge = scene.resolution.surface.value_or(out.crack_edge / 20);
  return out;
}

TriMesh scene_mesh(const Scene& scene) {
  return load_body(scene).surface;
}

}  // namespace conchoid
