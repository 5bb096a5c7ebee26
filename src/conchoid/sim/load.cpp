#include <fmt/core.h>

#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {
namespace {

double region_area(const TriMesh& surface, const Region& region) {
  double area = 0;
  for (TriId t : region.triangles)
    area += area_vector(surface, t).norm();
  return area;
}

BoundaryData conditions_of(const Scene& scene, const PreparedBody& body) {
  BoundaryData data = free_surface(body.surface);
  std::vector<int> setter(body.surface.node_count(), -1);  // displacement condition that holds a node
  for (std::size_t b = 0; b < scene.boundary.size(); ++b) {
    const BoundaryCondition& condition = scene.boundary[b];
    const Region* region = find_region(body.regions, condition.region);
    if (!region || region->triangles.empty())
      throw InputError(fmt::format("{}: region '{}' has no triangles; widen its half spaces", condition.where,
                                   condition.region));
    for (TriId t : region->triangles) {
      if (condition.kind != ConditionKind::displacement) {
        data.traction[t.index()] = condition.kind == ConditionKind::traction
                                       ? condition.value
                                       : Vec3(condition.value / region_area(body.surface, *region));
        continue;
      }
      data.kind[t.index()] = BoundaryKind::displacement;
      for (NodeId node : body.surface.corners[t]) {
        int& by = setter[node.index()];
        if (by >= 0 && data.displacement[node] != condition.value)
          throw InputError(
              fmt::format("{}: contradicts the condition at {}: regions '{}' and '{}' share node {} but "
                          "displace it differently; "
                          "leave a strip of free surface between them",
                          condition.where, scene.boundary[by].where, condition.region,
                          scene.boundary[by].region, node.value));
        by = static_cast<int>(b);
        data.displacement[node] = condition.value;
      }
    }
  }
  return data;
}

// Inertia relief of an unbalanced load: its stress is superposed, and its traction taken off the load.
AmbientField balance(const Scene& scene, const TriMesh& surface, BoundaryData& data) {
  if (!data.pure_traction()) return {};
  const Resultant r = resultant(surface, data);
  if (balanced(r, surface)) return {};
  const std::string where = scene.boundary.empty() ? scene.file : scene.boundary.front().where;
  if (!scene.run.inertia_relief)
    throw InputError(
        fmt::format("{}: the loads are out of balance (force {:.3g} {:.3g} {:.3g} N, moment {:.3g} {:.3g} "
                    "{:.3g} N m) and nothing is held: "
                    "fix a region, balance them, or set run.inertia_relief = true",
                    where, r.force.x(), r.force.y(), r.force.z(), r.moment.x(), r.moment.y(), r.moment.z()));
  AmbientField ambient = inertia_field(surface, r, scene.material.elastic());
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const auto& c = surface.corners[TriId(t)];
    const Vec3 n = unit_normal(surface, TriId(t));
    for (int k = 0; k < 3; ++k)  // mean over the triangle, exact for the field's quadratic stress
      data.traction[t] -=
          ambient.stress(0.5 * (surface.positions[c[k]] + surface.positions[c[(k + 1) % 3]])) * n / 3;
  }
  return ambient;
}

}  // namespace

std::vector<BoundaryKind> kinds_of(const Scene& scene, const PreparedBody& body) {
  return conditions_of(scene, body).kind;
}

LoadCase load_of(const Scene& scene, const PreparedBody& body) {
  if (body.infinite())
    return load_case(
        body.surface, free_surface(body.surface),
        uniform_stress(scene.remote_stress, scene.material.youngs_modulus, scene.material.poisson_ratio));
  BoundaryData data = conditions_of(scene, body);
  if (body.elastic && data.kind != body.elastic->kinds())
    throw InputError(
        (scene.boundary.empty() ? scene.file : scene.boundary.front().where) +
        ": the conditions hold other triangles than those that the body was prepared for; prepare it again");
  AmbientField ambient = balance(scene, body.surface, data);
  return load_case(body.surface, data, std::move(ambient));
}

}  // namespace conchoid
