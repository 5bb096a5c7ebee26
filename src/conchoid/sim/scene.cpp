#include "conchoid/sim/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "conchoid/core/error.hpp"
#include "conchoid/material/library.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/scene_parser.hpp"
#include "conchoid/sim/settings.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

template <class T>
std::optional<T> optional_value(const TomlTable& table, std::string_view key) {
  if (!table.has(key)) return std::nullopt;
  T value{};
  table.read(key, value);
  return value;
}

BodySpec read_body(const TomlTable& file, const fs::path& folder) {
  const auto table = file.table("body");
  if (!table) file.fail({}, "there is no [body]; add it, with model = \"cube\" or mesh = \"file.ply\"");
  table->require_known_keys();
  BodySpec body;
  body.where = table->where();
  if (one_of(*table, {"model", "mesh"}, "[body]") == "model")
    table->read("model", body.model);
  else
    body.mesh = existing_file(*table, "mesh", folder);
  body.remesh = optional_value<int>(*table, "remesh");
  table->read("follow_thickness", body.follow_thickness);
  table->read("scale", body.scale);
  body.scale_given = table->has("scale");
  for (const char* key : {"remesh", "follow_thickness", "scale"})
    if (body.infinite() && table->has(key))
      table->fail(
          key,
          fmt::format("body.{} does not go with model = \"infinite\", which has no surface; remove it", key));
  return body;
}

MaterialSpec read_material(const TomlTable& file, const fs::path& folder) {
  const auto table = file.table("material");
  if (!table)
    file.fail({}, "there is no [material]; add it, with a name, or youngs_modulus and poisson_ratio");
  table->require_known_keys();
  MaterialSpec m;
  table->read("name", m.name);
  if (const NamedMaterial* named = find_material(m.name)) {
    m.youngs_modulus = named->youngs_modulus;
    m.poisson_ratio = named->poisson_ratio;
    m.density = named->density;
    m.strength = named->strength;
    m.toughness = named->toughness;
    table->read("youngs_modulus", m.youngs_modulus);
    table->read("poisson_ratio", m.poisson_ratio);
  } else {
    table->require("youngs_modulus", m.youngs_modulus);
    table->require("poisson_ratio", m.poisson_ratio);
  }
  table->read("density", m.density);
  table->read("strength", m.strength);
  table->read("toughness", m.toughness);
  table->read("compressive_factor", m.compressive_factor);
  m.toughness_field = read_material_field(*table, "toughness_field", folder);
  m.strength_field = read_material_field(*table, "strength_field", folder);
  return m;
}

ResolutionSpec read_resolution(const TomlTable& file) {
  ResolutionSpec resolution;
  const auto table = file.table("resolution");
  if (!table) return resolution;
  table->require_known_keys();
  resolution.crack = optional_value<double>(*table, "crack");
  resolution.where = table->where();
  resolution.surface = optional_value<double>(*table, "surface");
  if (resolution.crack && resolution.surface && *resolution.surface > *resolution.crack)
    table->fail("surface",
                fmt::format("resolution.surface = {} is coarser than resolution.crack = {}; make it smaller",
                            *resolution.surface, *resolution.crack));
  return resolution;
}

Vec3 read_direction(const TomlTable& table, std::string_view key) {
  Vec3 v = Vec3::Zero();
  table.require(key, v);
  if (v.isZero(0)) table.fail(key, fmt::format("crack.{} is (0, 0, 0); give a direction", key));
  return v;
}

void read_ellipse(const TomlTable& table, CrackSpec& crack) {
  std::vector<double> axes;
  table.require("axes", axes);
  crack.axes = {axes[0], axes[1]};
  crack.normal = read_direction(table, "normal");
  if (!table.has("direction")) return;
  crack.direction = read_direction(table, "direction");
  if (cross(*crack.direction, crack.normal).norm() <= 1e-6 * crack.direction->norm() * crack.normal.norm())
    table.fail("direction", "crack.direction is along crack.normal; it must lie in the crack's plane");
}

void read_rectangle(const TomlTable& table, CrackSpec& crack) {
  std::vector<std::vector<double>> edges;
  table.require("edges", edges);
  if (edges.size() != 2)
    table.fail("edges", fmt::format("crack.edges holds {} vectors, but must hold 2", edges.size()));
  crack.edge1 = Vec3(edges[0][0], edges[0][1], edges[0][2]);
  crack.edge2 = Vec3(edges[1][0], edges[1][1], edges[1][2]);
  if (cross(crack.edge1, crack.edge2).norm() <= 1e-6 * crack.edge1.norm() * crack.edge2.norm())
    table.fail("edges", "crack.edges are parallel or zero; a rectangle needs two edges at a right angle");
  if (std::abs(crack.edge1.dot(crack.edge2)) > 1e-6 * crack.edge1.norm() * crack.edge2.norm())
    table.fail("edges", "crack.edges are not at a right angle; correct them, or give the crack as a mesh");
}

CrackSpec read_crack(const TomlTable& table, const fs::path& folder) {
  table.require_known_keys();
  std::string kind;
  table.require("kind", kind);
  require_keys_of_kind(table, "crack", kind,
                       {{"center", {"disc", "ellipse", "rectangle"}},
                        {"normal", {"disc", "ellipse"}},
                        {"radius", {"disc"}},
                        {"axes", {"ellipse"}},
                        {"direction", {"disc", "ellipse"}},
                        {"edges", {"rectangle"}},
                        {"file", {"mesh"}},
                        {"triangles", {"disc", "ellipse", "rectangle"}}});
  CrackSpec crack;
  crack.where = table.where();
  crack.triangles = optional_value<int>(table, "triangles");
  if (kind == "mesh") {
    crack.kind = CrackKind::mesh;
    crack.file = existing_file(table, "file", folder);
    return crack;
  }
  table.require("center", crack.center);
  if (kind == "disc") {
    crack.kind = CrackKind::disc;
    crack.normal = read_direction(table, "normal");
    table.require("radius", crack.radius);
    if (table.has("direction")) crack.direction = read_direction(table, "direction");
  } else if (kind == "ellipse") {
    crack.kind = CrackKind::ellipse;
    read_ellipse(table, crack);
  } else {
    crack.kind = CrackKind::rectangle;
    read_rectangle(table, crack);
  }
  return crack;
}

Mat3 read_remote_stress(const TomlTable& file, const Scene& scene) {
  Mat3 stress = Mat3::Zero();
  const auto table = file.table("remote_stress");
  if (!table) return stress;
  table->require_known_keys();
  if (!scene.body.infinite())
    table->fail(
        {}, "[remote_stress] goes with model = \"infinite\" only; give the loads of a body as [[boundary]]");
  std::vector<double> t;
  table->require("tensor", t);
  stress << t[0], t[5], t[4], t[5], t[1], t[3], t[4], t[3], t[2];
  return stress;
}

RunSpec read_run(const TomlTable& file) {
  RunSpec run;
  const auto table = file.table("run");
  if (!table) return run;
  table->require_known_keys();
  table->read("frames", run.frames);
  table->read("max_cracks", run.max_cracks);
  table->read("max_cracks_per_frame", run.max_cracks_per_frame);
  table->read("smallest_body", run.smallest_body);
  table->read("seed", run.seed);
  table->read("inertia_relief", run.inertia_relief);
  table->read("contact", run.contact);
  table->read("quadrature_tolerance", run.quadrature_tolerance);
  table->read("smallest_fragment", run.smallest_fragment);
  table->read("max_fragments", run.max_fragments);
  table->read("solve_every", run.solve_every);
  std::string sif = "two-point", convention = "full-opening", rayleigh = "exact", compression = "closed",
              after = "continue", elements = "auto";
  table->read("elements", elements);
  run.elements = elements == "linear"      ? ElementOrder::linear
                 : elements == "quadratic" ? ElementOrder::quadratic
                                           : ElementOrder::by_walls;
  table->read("sif", sif);
  table->read("sif_convention", convention);
  table->read("rayleigh", rayleigh);
  run.sif = sif == "two-point" ? SifSource::two_point : SifSource::one_point;
  run.sif_convention = convention == "full-opening" ? OpeningConvention::full : OpeningConvention::half;
  run.exact_rayleigh_speed = rayleigh == "exact";
  table->read("compression", compression);
  table->read("after_separation", after);
  run.after_separation = after == "stop" ? AfterSeparation::stop : AfterSeparation::go_on;
  run.published_compression = compression == "published";
  if (run.published_compression && run.contact)
    table->fail("compression",
                "compression = \"published\" goes with contact = false: faces in contact feel no K_I < 0");
  return run;
}

}  // namespace

fs::path existing_file(const TomlTable& table, std::string_view key, const fs::path& folder) {
  std::string name;
  table.require(key, name);
  return existing_file(table, key, name, folder);
}

fs::path existing_file(const TomlTable& table, std::string_view key, const std::string& name,
                       const fs::path& folder) {
  const fs::path path = folder / name;
  if (!fs::is_regular_file(path))
    table.fail(key, fmt::format("there is no file {}; file names are relative to the scene's folder",
                                path.string()));
  return path;
}

std::string_view one_of(const TomlTable& table, const std::vector<std::string_view>& keys,
                        std::string_view what) {
  std::vector<std::string_view> given;
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(given), [&](auto key) { return table.has(key); });
  if (given.empty()) table.fail({}, fmt::format("{} needs one of {}; add it", what, fmt::join(keys, ", ")));
  if (given.size() > 1)
    table.fail(given[1], fmt::format("{} has {}; they contradict each other, keep one", what,
                                     fmt::join(given, " and ")));
  return given.front();
}

Mat3 read_axes(const TomlTable& table, std::string_view name) {
  constexpr double square = 1e-6;  // cosine of axes that count as being at right angles
  Mat3 out = Mat3::Identity();
  std::vector<std::vector<double>> axes;
  table.read("axes", axes);
  if (axes.empty()) return out;
  if (axes.size() != 3)
    table.fail("axes", fmt::format("{}.axes holds {} vectors, but must hold 3", name, axes.size()));
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis(axes[k][0], axes[k][1], axes[k][2]);
    if (axis.isZero(0)) table.fail("axes", fmt::format("{}.axes holds (0, 0, 0); give directions", name));
    out.col(k) = axis / axis.norm();
  }
  const Mat3 products = out.transpose() * out;
  if ((products - Mat3::Identity()).cwiseAbs().maxCoeff() > square)
    table.fail("axes", fmt::format("{}.axes are not at right angles; correct them", name));
  return out;
}

/// Keys that belong to another kind are contradictions.
void require_keys_of_kind(
    const TomlTable& table, std::string_view name, const std::string& kind,
    const std::vector<std::pair<std::string_view, std::set<std::string>>>& kinds_of_key) {
  for (const auto& [key, kinds] : kinds_of_key)
    if (table.has(key) && !kinds.contains(kind))
      table.fail(key, fmt::format("{}.{} does not go with kind = \"{}\" but with {}; remove it", name, key,
                                  kind, fmt::join(kinds, ", ")));
}

std::string read_text_file(const fs::path& path) {
  if (fs::is_directory(path)) throw InputError(path.string() + ": is a folder; name the file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()))
    throw InputError(path.string() + ": cannot be read, or is empty; check the name and its permissions");
  return text.str();
}

void require_region(const Scene& scene, const std::string& region, const TomlTable& table,
                    std::string_view key) {
  std::vector<std::string> names;
  for (const SceneRegion& r : scene.regions)
    names.push_back(r.rule.name);
  if (!scene.body.model.empty())
    for (const Region& r : built_in_model(scene.body.model).regions)
      names.push_back(r.name);
  if (std::find(names.begin(), names.end(), region) != names.end()) return;
  if (names.empty())
    table.fail(key, fmt::format("there is no region \"{}\"; define it with [[region]]", region));
  table.fail(key, fmt::format("there is no region \"{}\"; choose from {} or define it with [[region]]",
                              region, fmt::join(names, ", ")));
}

Scene scene_from(const TomlTable& file, const std::string& name, const fs::path& folder) {
  Scene scene;
  scene.file = name;
  scene.body = read_body(file, folder);
  scene.material = read_material(file, folder);
  scene.resolution = read_resolution(file);
  read_regions(file, scene);
  read_boundary(file, scene);
  read_body_force(file, scene);
  for (const TomlTable& table : file.tables("crack"))
    scene.cracks.push_back(read_crack(table, folder));
  scene.remote_stress = read_remote_stress(file, scene);
  scene.run = read_run(file);
  scene.output = read_output(file);
  if (scene.body.infinite() && scene.cracks.empty())
    file.fail(
        {}, "model = \"infinite\" has no surface and there is no crack: nothing to compute; add a [[crack]]");
  return scene;
}

Scene parse_scene(std::string_view text, const std::string& name, const fs::path& folder) {
  const TomlTable file = TomlTable::parse(text, name);
  file.require_known_keys();
  Scene scene = scene_from(file, name, folder);
  scene.text = std::string(text);
  return scene;
}

Scene read_scene(const fs::path& path) {
  return parse_scene(read_text_file(path), path.string(), path.parent_path());
}

std::vector<Vec3> BoundaryCondition::held_directions() const {
  std::vector<Vec3> directions;
  for (int k = 0; k < 3; ++k)
    if (held[static_cast<std::size_t>(k)]) directions.emplace_back(axes.col(k));
  return directions;
}

Mat3 BoundaryCondition::free_directions() const {
  Mat3 free = Mat3::Identity();
  if (kind == ConditionKind::displacement)
    for (const Vec3& d : held_directions())
      free -= d * d.transpose();
  return free;
}

BoundaryCondition BoundaryCondition::load() const {
  BoundaryCondition out = *this;
  if (kind != ConditionKind::displacement) return out;
  out.kind = free_kind;
  out.value = free_value;
  return out;
}

bool BoundaryCondition::is_loaded() const {
  const Vec3& load = kind == ConditionKind::displacement ? free_value : value;
  return !load.isZero(0) || !moment.isZero(0) || !twist.isZero(0) || pressure != 0;
}

}  // namespace conchoid
