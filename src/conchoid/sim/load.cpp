#include <fmt/core.h>

#include <Eigen/LU>
#include <cmath>

#include "conchoid/bem/body_force.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/sim/body_elements.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/spread_force.hpp"

namespace conchoid {
namespace {

// The displacement of nodes, component by component, as conditions prescribe it.
class PrescribedNodes {
 public:
  PrescribedNodes(const Scene& scene, const PreparedBody& body)
      : scene_(scene), body_(body), nodes_(body.surface.node_count()) {}

  void prescribe(NodeId id, std::size_t condition, const Mat3& held, const Vec3& value) {
    Node& node = nodes_[id.index()];
    if (node.by == static_cast<int>(condition)) return;
    if (node.by < 0) {
      node = {static_cast<int>(condition), held, value};
      return;
    }
    constexpr double smallest_angle = 0.01;  // between directions that are held apart [rad]
    constexpr double same_value = 1e-6;      // of the values
    const Mat3 added = join_held(node.held, held) - node.held;
    const Mat3 seen = added * held * added + (Mat3::Identity() - added);
    if (seen.determinant() < smallest_angle * smallest_angle)
      refuse(id, condition, "hold it along directions that are nearly the same",
             "give both the same axes, or leave a strip of free surface between them");
    const Vec3 moved = node.value + added * (seen.inverse() * (added * (value - held * node.value)));
    if ((held * moved - value).norm() > same_value * (value.norm() + node.value.norm()))
      refuse(id, condition, "displace it differently",
             "give it one displacement in both, leave a component free, or leave a strip of free surface "
             "between them");
    node.held += added;
    node.value = moved;
    node.by = static_cast<int>(condition);
  }

  const Vec3& value(NodeId id) const { return nodes_[id.index()].value; }

 private:
  struct Node {
    int by = -1;  // the condition that held it last
    Mat3 held = Mat3::Zero();
    Vec3 value = Vec3::Zero();
  };

  [[noreturn]] void refuse(NodeId id, std::size_t condition, const char* what, const char* remedy) const {
    const BoundaryCondition &one = scene_.boundary[condition],
                            &other = scene_.boundary[static_cast<std::size_t>(nodes_[id.index()].by)];
    const Vec3 x = body_.surface.positions[id] + body_.origin;
    throw InputError(fmt::format(
        "{}: contradicts the condition at {}: regions '{}' and '{}' share node {} at "
        "({:.4g}, {:.4g}, {:.4g}), but {}; {}",
        one.where, other.where, one.region, other.region, id.value, x[0], x[1], x[2], what, remedy));
  }

  const Scene& scene_;
  const PreparedBody& body_;
  std::vector<Node> nodes_;
};

void hold(const TriMesh& surface, const Region& region, const BoundaryCondition& condition,
          std::size_t number, PrescribedNodes& nodes, BoundaryData& data) {
  const BoundaryKind kind = BoundaryKind::holding(condition.held_directions());
  for (TriId t : region.triangles) {
    data.kind[t.index()] = kind;
    for (NodeId node : surface.corners[t])
      nodes.prescribe(node, number, kind.held(), condition.value);
  }
}

void load(const PreparedBody& body, const Region& region, const BoundaryCondition& condition,
          BoundaryData& data) {
  const Mat3 free = condition.free_directions();
  const BoundaryCondition acting = condition.load();
  LinearTraction given{acting.value, acting.twist, acting.about - body.origin};
  if (acting.kind == ConditionKind::force) given = spread_force(body.surface, region, condition);
  bool acts = false;
  for (TriId t : region.triangles) {
    const Vec3 traction = acting.kind == ConditionKind::pressure
                              ? Vec3(-acting.pressure * unit_normal(body.surface, t))
                              : given.at(centroid(body.surface, t));
    data.traction[t.index()] = free * traction;
    acts = acts || data.traction[t.index()].norm() > 1e-9 * traction.norm();
  }
  if (!acts && condition.is_loaded())
    throw InputError(fmt::format(
        "{}: the load on region '{}' acts only in directions whose displacement is prescribed there, so that "
        "nothing feels it; leave a component \"free\" along which it acts, or remove it",
        condition.where, condition.region));
}

BoundaryData conditions_of(const Scene& scene, const PreparedBody& body) {
  BoundaryData data = free_surface(body.surface);
  PrescribedNodes nodes(scene, body);
  for (std::size_t b = 0; b < scene.boundary.size(); ++b) {
    const BoundaryCondition& condition = scene.boundary[b];
    const Region* region = find_region(body.regions, condition.region);
    if (!region || region->triangles.empty())
      throw InputError(
          fmt::format("{}: region '{}' has no triangles; widen it", condition.where, condition.region));
    if (condition.kind == ConditionKind::displacement) hold(body.surface, *region, condition, b, nodes, data);
    load(body, *region, condition, data);
  }
  for (std::size_t i = 0; i < body.surface.node_count(); ++i)
    data.displacement[NodeId(i)] = nodes.value(NodeId(i));
  return data;
}

// Components that are round-off beside `size` are zero.
std::string text_of(const Vec3& v, double size) {
  const auto clean = [&](double x) { return std::abs(x) < 1e-9 * size ? 0.0 : x; };
  return fmt::format("{:.3g} {:.3g} {:.3g}", clean(v.x()), clean(v.y()), clean(v.z()));
}

// The motion into which loads drive a body that its supports do not hold.
std::string motion_text(const PreparedBody& body, const std::vector<RigidMotion>& motions,
                        const Resultant& driven) {
  const double size = bounding_box(body.surface).diagonal();
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  for (const RigidMotion& m : motions) {
    const double push = m.v.dot(driven.force) + m.omega.dot(driven.moment);
    v += push * m.v;
    omega += push * m.omega;
  }
  if (omega.norm() * size < 1e-3 * v.norm())
    return fmt::format("a translation along ({})", text_of(v / v.norm(), 1));
  const Vec3 on_axis = driven.center + body.origin + cross(omega, v) / omega.squaredNorm();
  return fmt::format("a rotation about ({}) through ({})", text_of(omega / omega.norm(), 1),
                     text_of(on_axis, size));
}

[[noreturn]] void refuse_unbalanced(const Scene& scene, const PreparedBody& body, const Resultant& driven,
                                    const std::vector<RigidMotion>& motions) {
  const std::string where = scene.boundary.empty() ? scene.file : scene.boundary.front().where;
  const std::string loads = fmt::format(
      "the loads are out of balance (force {} N, moment {} N m)", text_of(driven.force, driven.scale),
      text_of(driven.moment, driven.scale * bounding_box(body.surface).diagonal()));
  if (motions.size() == 6)
    throw InputError(
        fmt::format("{}: {} and nothing is held: "
                    "fix a region, balance them, or set run.inertia_relief = true",
                    where, loads));
  throw InputError(
      fmt::format("{}: {} in a motion that the supports leave free, {}: hold a region against it (a "
                  "[[boundary]] with that component of `displacement`), balance the loads, or set "
                  "run.inertia_relief = true",
                  where, loads, motion_text(body, motions, driven)));
}

// The field that belongs to weight and spin, and, where loads are out of balance, to the inertia that relieves them.
AmbientField body_field(const Scene& scene, const PreparedBody& body, const BoundaryData& data) {
  const TriMesh& surface = body.surface;
  const Vec3 center = volume_moments(surface).center;
  const BodyForceSpec& spec = scene.body_force;
  BodyForce force = weight_and_spin(center, scene.material.density, spec.gravity, spec.spin,
                                    spec.on_axis ? Vec3(*spec.on_axis - body.origin) : center);
  const Resultant r = with_body_force(surface, resultant(surface, data), force);
  const std::vector<RigidMotion> motions = free_motions(surface, data.kind, r.center);
  const Resultant driven = unsupported(surface, r, motions);
  if (!balanced(driven, surface)) {
    if (!scene.run.inertia_relief) refuse_unbalanced(scene, body, driven, motions);
    const BodyForce inertia = inertia_force(surface, driven);
    force.uniform += inertia.uniform;
    force.turning += inertia.turning;
  }
  return particular_field(force, scene.material.elastic());
}

// What the elements compute is the rest: an ambient field's traction and displacement are taken off the data.
void take_off(const AmbientField& ambient, const TriMesh& surface, BoundaryData& data) {
  if (!ambient.stress) return;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const auto& c = surface.corners[TriId(t)];
    const Vec3 n = unit_normal(surface, TriId(t));
    for (int k = 0; k < 3; ++k)  // mean over the triangle, exact for a field of quadratic stress
      data.traction[t] -=
          ambient.stress(0.5 * (surface.positions[c[k]] + surface.positions[c[(k + 1) % 3]])) * n / 3;
  }
  for (std::size_t i = 0; i < surface.node_count(); ++i)
    data.displacement[NodeId(i)] -= ambient.displacement(surface.positions[NodeId(i)]);
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
  AmbientField ambient = body_field(scene, body, data);
  take_off(ambient, body.surface, data);
  return as_elements_take(load_case(body.surface, data, std::move(ambient)), body);
}

}  // namespace conchoid
