#include <fmt/format.h>

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/scene_parser.hpp"

namespace conchoid {
namespace {

bool anything_held(const BoundaryCondition& condition) {
  return std::any_of(condition.held.begin(), condition.held.end(), [](bool held) { return held; });
}

// displacement, with "free" components, and the traction that those may have.
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
  if (!table.has("traction")) return;
  Vec3 traction = Vec3::Zero();
  table.read("traction", traction);
  for (std::size_t k = 0; k < 3; ++k)
    if (condition.held[k] && traction[static_cast<int>(k)] != 0)
      table.fail("traction", fmt::format("boundary.traction has {} Pa along axis {}, whose displacement is "
                                         "prescribed; make it 0, or \"free\" there",
                                         traction[static_cast<int>(k)], k + 1));
  condition.free_traction = condition.axes * traction;
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

BoundaryCondition read_condition(const TomlTable& table) {
  table.require_known_keys();
  BoundaryCondition condition{.region = {}, .where = table.where()};
  table.require("region", condition.region);
  condition.axes = read_axes(table, "boundary");
  const auto has = [&](const std::vector<std::string_view>& keys) {
    return std::any_of(keys.begin(), keys.end(), [&](auto key) { return table.has(key); });
  };
  if (table.has("displacement") && !has({"force", "moment", "pressure", "fixed"})) {
    condition.kind = ConditionKind::displacement;
    read_displacement(table, condition);
    return condition;
  }
  if (has({"force", "moment"}) && !has({"traction", "pressure", "displacement", "fixed"})) {
    condition.kind = ConditionKind::force;
    read_vector(table, "force", condition.axes, condition.value);
    read_vector(table, "moment", condition.axes, condition.moment);
    return condition;
  }
  const std::string_view key =
      one_of(table, {"traction", "force", "moment", "pressure", "displacement", "fixed"}, "[[boundary]]");
  if (key == "fixed") {
    require_held(table);
    condition.kind = ConditionKind::displacement;
  } else if (key == "pressure") {
    condition.kind = ConditionKind::pressure;
    table.read("pressure", condition.pressure);
  } else {
    condition.kind = ConditionKind::traction;
    read_vector(table, "traction", condition.axes, condition.value);
  }
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
