#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/scene_parser.hpp"

namespace conchoid {
namespace {

bool anything_held(const BoundaryCondition& condition) {
  return std::any_of(condition.held.begin(), condition.held.end(), [](bool held) { return held; });
}

// displacement, with "free" components.
void read_displacement(const TomlTable& table, BoundaryCondition& condition) {
  std::array<std::optional<double>, 3> components;
  table.read("displacement", components);
  Vec3 value = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    condition.held[k] = components[k].has_value();
    value[static_cast<int>(k)] = components[k].value_or(0);
  }
  if (!anything_held(condition))
    table.fail("displacement",
               "boundary.displacement leaves every component free, which says nothing; prescribe one or "
               "remove this [[boundary]]");
  condition.value = condition.axes * value;
}

void read_vector(const TomlTable& table, std::string_view key, const Mat3& axes, Vec3& value) {
  Vec3 components = Vec3::Zero();
  table.read(key, components);
  value = axes * components;
}

void require_held(const TomlTable& table) {
  bool fixed = false;
  table.read("fixed", fixed);
  if (!fixed)
    table.fail("fixed", "fixed = false says nothing; remove this [[boundary]] or write fixed = true");
}

bool has_any(const TomlTable& table, const std::vector<std::string_view>& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](auto key) { return table.has(key); });
}

// traction, force with or without a moment, or pressure.
void read_load(const TomlTable& table, BoundaryCondition& condition, ConditionKind& kind, Vec3& value) {
  if (has_any(table, {"force", "moment"})) {
    if (has_any(table, {"traction", "pressure"}))
      one_of(table, {"traction", "force", "moment", "pressure"}, "[[boundary]]");
    kind = ConditionKind::force;
    read_vector(table, "force", condition.axes, value);
    read_vector(table, "moment", condition.axes, condition.moment);
  } else if (one_of(table, {"traction", "pressure"}, "[[boundary]]") == "pressure") {
    kind = ConditionKind::pressure;
    table.read("pressure", condition.pressure);
  } else {
    kind = ConditionKind::traction;
    read_vector(table, "traction", condition.axes, value);
  }
}

// Along what is held a load would go straight into the support.
void require_free(const TomlTable& table, std::string_view key, const Vec3& value,
                  const BoundaryCondition& condition) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double component = condition.axes.col(static_cast<int>(k)).dot(value);
    if (condition.held[k] && std::abs(component) > 1e-12 * value.norm())
      table.fail(key, fmt::format("boundary.{} has {} along axis {}, whose displacement is prescribed; make "
                                  "it 0, or the displacement \"free\" there",
                                  key, component, k + 1));
  }
}

BoundaryCondition read_condition(const TomlTable& table) {
  table.require_known_keys();
  BoundaryCondition condition{.region = {}, .where = table.where()};
  table.require("region", condition.region);
  condition.axes = read_axes(table, "boundary");
  const std::vector<std::string_view> loads{"traction", "force", "moment", "pressure"};
  if (table.has("displacement") && !table.has("fixed")) {
    condition.kind = ConditionKind::displacement;
    read_displacement(table, condition);
    if (has_any(table, loads)) {
      read_load(table, condition, condition.free_kind, condition.free_value);
      require_free(table, condition.free_kind == ConditionKind::force ? "force" : "traction",
                   condition.free_value, condition);
    }
    return condition;
  }
  if (has_any(table, {"displacement", "fixed"}) || !has_any(table, loads)) {
    one_of(table, {"traction", "force", "moment", "pressure", "displacement", "fixed"}, "[[boundary]]");
    require_held(table);
    condition.kind = ConditionKind::displacement;
    return condition;
  }
  read_load(table, condition, condition.kind, condition.value);
  return condition;
}

}  // namespace

void read_boundary(const TomlTable& file, Scene& scene) {
  for (const TomlTable& table : file.tables("boundary")) {
    BoundaryCondition condition = read_condition(table);
    if (scene.body.infinite())
      table.fail(
          {},
          "[[boundary]] does not go with model = \"infinite\", which has no surface; use [remote_stress]");
    require_region(scene, condition.region, table, "region");
    for (const BoundaryCondition& other : scene.boundary)
      if (other.region == condition.region)
        table.fail("region", fmt::format("the region \"{}\" already has a condition at {}; keep one of them",
                                         condition.region, other.where));
    scene.boundary.push_back(std::move(condition));
  }
}

void read_body_force(const TomlTable& file, Scene& scene) {
  const auto table = file.table("body_force");
  if (!table) return;
  table->require_known_keys();
  if (scene.body.infinite())
    table->fail({}, "[body_force] does not go with model = \"infinite\", which has no weight; remove it");
  BodyForceSpec& force = scene.body_force;
  table->read("gravity", force.gravity);
  table->read("spin", force.spin);
  if (!table->has("axis_through")) return;
  if (!table->has("spin"))
    table->fail("axis_through", "body_force.axis_through goes with `spin`; add that, or remove this");
  force.on_axis = Vec3::Zero();
  table->read("axis_through", *force.on_axis);
}

}  // namespace conchoid
