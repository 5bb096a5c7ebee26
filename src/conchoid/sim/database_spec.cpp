#include "conchoid/sim/database_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/learn/regressor.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/sim/scene_parser.hpp"
#include "conchoid/sim/world_bodies.hpp"

namespace conchoid {
namespace {

std::array<double, 2> read_interval(const TomlTable& table, std::string_view key,
                                    std::array<double, 2> standard) {
  std::vector<double> ends(standard.begin(), standard.end());
  table.read(key, ends);
  if (ends[0] > ends[1])
    table.fail(key, fmt::format("database.{} runs from {} down to {}; give the smaller value first", key,
                                ends[0], ends[1]));
  return {ends[0], ends[1]};
}

void read_loaded_regions(const TomlTable& table, DatabaseSpec& spec) {
  std::vector<std::string> names;
  table.require("regions", names);
  if (names.empty() || names.size() > 2)
    table.fail(
        "regions",
        fmt::format("database.regions holds {} names; give the pulled region, and the one that gets the "
                    "opposite traction if there is one",
                    names.size()));
  for (const std::string& name : names) {
    require_region(spec.scene, name, table, "regions");
    for (const BoundaryCondition& condition : spec.scene.boundary)
      if (condition.region == name)
        table.fail("regions",
                   fmt::format("the region \"{}\" already has a condition at {}; remove it, or load another "
                               "region",
                               name, condition.where));
  }
  spec.pulled = names[0];
  if (names.size() == 1) return;
  if (names[0] == names[1])
    table.fail(
        "regions",
        fmt::format("the region \"{}\" is given twice; the loads would cancel, name two regions", names[0]));
  spec.opposite = names[1];
}

void read_loads(const TomlTable& table, DatabaseSpec& spec) {
  read_loaded_regions(table, spec);
  table.read("direction", spec.pole);
  if (spec.pole.isZero(0)) table.fail("direction", "database.direction is (0, 0, 0); give a direction");
  spec.pole.normalize();
  if (!table.has("magnitude"))
    table.fail({}, "[database] lacks magnitude (smallest and largest traction, Pa); add it");
  spec.magnitude = read_interval(table, "magnitude", {});
  spec.slope = read_interval(table, "slope", spec.slope);
  spec.rotation = read_interval(table, "rotation", spec.rotation);
}

void require_nothing_beside_world(const TomlTable& file, const TomlTable& database) {
  for (const char* key : {"body", "material", "resolution", "region", "boundary", "body_force", "crack",
                          "remote_stress", "run", "output"})
    if (file.has(key))
      file.fail(key, fmt::format("[{}] does not go with [world], which draws it; remove one of them", key));
  for (const char* key : {"regions", "direction", "magnitude", "slope", "rotation", "exclude_above"})
    if (database.has(key))
      database.fail(key,
                    fmt::format("database.{} does not go with [world], which draws loads; remove it", key));
}

// @param files  those that it names are appended
WorldSpec read_world(const TomlTable& table, const std::filesystem::path& folder,
                     std::vector<std::filesystem::path>& files) {
  table.require_known_keys();
  WorldSpec world;
  std::vector<std::string> scans;
  table.read("scans", scans);
  for (const std::string_view name : scans.empty() ? body_class_names() : world_class_names())
    world.classes.emplace_back(name);
  table.read("classes", world.classes);
  if (world.classes.empty())
    table.fail("classes", "world.classes is empty; name one, or leave it out for all");
  const bool wanted =
      std::find(world.classes.begin(), world.classes.end(), kScanClass) != world.classes.end();
  if (wanted && scans.empty())
    table.fail("classes", "bodies of the class \"scan\" are made from meshes; name some as world.scans");
  if (!wanted && !scans.empty())
    table.fail("scans", "no body is made from these; add \"scan\" to world.classes, or remove them");
  table.read("runs_per_body", world.runs_per_body);
  table.read("elements", world.elements);
  table.read("cracked", world.cracked);
  for (const std::string& name : scans) {
    files.push_back(existing_file(table, "scans", name, folder));
    world.scans.push_back(scan_of(body_from_file(files.back()).detailed, world.elements));
  }
  return world;
}

// A file beside the specification, or what comes with the program.
void read_leader(const TomlTable& table, const std::filesystem::path& folder, DatabaseSpec& spec) {
  std::string name;
  table.read("led_by", name);
  if (name.empty()) return;
  const std::filesystem::path beside = folder / name;
  try {
    spec.files.push_back(std::filesystem::exists(beside) ? beside : database_file(name, "network"));
    spec.led_by = load_regressor(spec.files.back());
  } catch (const InputError& error) {
    table.fail("led_by", fmt::format("database.led_by: {}", error.what()));
  }
}

}  // namespace

DatabaseSpec parse_database_spec(std::string_view text, const std::string& name,
                                 const std::filesystem::path& folder) {
  const TomlTable file = TomlTable::parse(text, name);
  file.require_known_keys(true);
  const auto table = file.table("database");
  if (!table) file.fail({}, "there is no [database]; add it, with regions and magnitude");
  table->require_known_keys();

  DatabaseSpec spec;
  if (const auto world = file.table("world")) {
    require_nothing_beside_world(file, *table);
    spec.world = read_world(*world, folder, spec.files);
    spec.scene.file = name;
    spec.exclusion.alpha_limit = 90;
  } else {
    spec.scene = scene_from(file, name, folder);
    if (spec.scene.body.infinite())
      file.table("body")->fail("model",
                               "model = \"infinite\" has no surface to pull at; choose another model");
    if (const auto run = file.table("run"); run && run->has("frames"))
      run->fail("frames", "in a database specification the frames are given in [database]; move it there");
    if (!spec.scene.body.mesh.empty()) spec.files.push_back(spec.scene.body.mesh);
    for (const CrackSpec& crack : spec.scene.cracks)
      if (!crack.file.empty()) spec.files.push_back(crack.file);
    read_loads(*table, spec);
    table->read("exclude_above", spec.exclusion.alpha_limit);
  }
  spec.scene.text = std::string(text);
  table->read("runs", spec.runs);
  table->read("seed", spec.seed);
  table->read("frames", spec.exclusion.frame_limit);
  table->read("many_cracks", spec.exclusion.many_cracks);
  table->read("tiny_growth", spec.exclusion.tiny_growth);
  read_leader(*table, folder, spec);
  spec.scene.run.frames = spec.exclusion.frame_limit;
  return spec;
}

std::string body_class(const BodySpec& body) {
  return body.model.empty() ? body.mesh.filename().string() : body.model;
}

DatabaseSpec read_database_spec(const std::filesystem::path& path) {
  return parse_database_spec(read_text_file(path), path.string(), path.parent_path());
}

DrawnLoad draw_load(const DatabaseSpec& spec, int run) {
  Random random(spec.seed, static_cast<std::uint64_t>(run));
  DrawnLoad load;
  load.seed = random.bits() >> 11;  // fits [run] seed
  load.slope = random.uniform(spec.slope[0], spec.slope[1]);
  load.rotation = random.uniform(spec.rotation[0], spec.rotation[1]);
  load.magnitude = random.uniform(spec.magnitude[0], spec.magnitude[1]);

  Eigen::Index nearest = 0;
  spec.pole.cwiseAbs().maxCoeff(&nearest);
  const Vec3 axis = Vec3::Unit((nearest + 1) % 3);
  const Vec3 e1 = (axis - axis.dot(spec.pole) * spec.pole).normalized();
  const Vec3 e2 = cross(spec.pole, e1);
  const double alpha = load.slope * std::numbers::pi / 180, beta = load.rotation * std::numbers::pi / 180;
  load.direction =
      std::sin(alpha) * (std::cos(beta) * e1 + std::sin(beta) * e2) + std::cos(alpha) * spec.pole;
  return load;
}

Scene loaded_scene(const DatabaseSpec& spec, const DrawnLoad& load) {
  Scene scene = spec.scene;
  const Vec3 traction = load.magnitude * load.direction;
  const auto is_held = [](const BoundaryCondition& c) { return c.kind == ConditionKind::displacement; };
  scene.run.inertia_relief = std::none_of(scene.boundary.begin(), scene.boundary.end(), is_held);
  scene.run.seed = load.seed;
  const std::string where = scene.file + ": [database]";
  scene.boundary.push_back(
      {.region = spec.pulled, .kind = ConditionKind::traction, .value = traction, .where = where});
  if (!spec.opposite.empty())
    scene.boundary.push_back(
        {.region = spec.opposite, .kind = ConditionKind::traction, .value = -traction, .where = where});
  return scene;
}

}  // namespace conchoid
