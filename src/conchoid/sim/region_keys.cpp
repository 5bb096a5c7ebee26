#include <fmt/format.h>

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/region_reach.hpp"
#include "conchoid/sim/scene_parser.hpp"

namespace conchoid {
namespace {

void read_half_spaces(const TomlTable& table, RegionRule& rule) {
  std::vector<std::vector<double>> rows;
  table.read("half_spaces", rows);
  for (const auto& row : rows) {
    const HalfSpace half{.normal = {row[0], row[1], row[2]}, .offset = row[3]};
    if (half.normal.isZero(0))
      table.fail("half_spaces", "a half space has the normal (0, 0, 0); give its direction");
    rule.half_spaces.push_back(half);
  }
}

void read_box(const TomlTable& table, RegionRule& rule) {
  std::vector<std::vector<double>> corners;
  table.read("box", corners);
  if (corners.empty()) return;
  if (corners.size() != 2)
    table.fail("box",
               fmt::format("region.box holds {} points, but must hold 2: opposite corners", corners.size()));
  const Vec3 a(corners[0][0], corners[0][1], corners[0][2]), b(corners[1][0], corners[1][1], corners[1][2]);
  rule.box = Box{a.cwiseMin(b), a.cwiseMax(b)};
}

std::optional<RoundBody> read_ball(const TomlTable& table, std::string_view key) {
  if (!table.has(key)) return std::nullopt;
  std::vector<double> values;
  table.read(key, values);
  if (values[3] <= 0)
    table.fail(key, fmt::format("region.{} has the radius {}, its last number; make it > 0", key, values[3]));
  return RoundBody{{values[0], values[1], values[2]}, values[3], std::nullopt};
}

void read_indenter(const TomlTable& table, RegionRule& rule) {
  rule.indenter = read_ball(table, "indenter");
  for (const char* key : {"indenter_axis", "within"})
    if (!rule.indenter && table.has(key))
      table.fail(key, fmt::format("region.{} goes with `indenter`; add that, or remove this", key));
  if (!rule.indenter) return;
  table.require("within", rule.reach);
  if (!table.has("indenter_axis")) return;
  Vec3 axis = Vec3::Zero();
  table.read("indenter_axis", axis);
  if (axis.isZero(0)) table.fail("indenter_axis", "region.indenter_axis is (0, 0, 0); give a direction");
  rule.indenter->axis = axis / axis.norm();
}

SceneRegion read_region(const TomlTable& table) {
  table.require_known_keys();
  SceneRegion region{.rule = {}, .edge = {}, .where = table.where()};
  RegionRule& rule = region.rule;
  table.require("name", rule.name);
  const std::vector<std::string_view> choices{"half_spaces", "box",   "sphere", "indenter",
                                              "material",    "group", "nearest"};
  if (std::none_of(choices.begin(), choices.end(), [&](auto key) { return table.has(key); }))
    table.fail({}, fmt::format("[[region]] says nothing about where it is; add one of {}",
                               fmt::join(choices, ", ")));
  read_half_spaces(table, rule);
  read_box(table, rule);
  rule.ball = read_ball(table, "sphere");
  read_indenter(table, rule);
  table.read("material", rule.material);
  table.read("group", rule.group);
  if (table.has("nearest")) {
    rule.nearest = Vec3::Zero();
    table.read("nearest", *rule.nearest);
  }
  table.read("initiation", region.initiation);
  if (table.has("edge")) {
    region.edge.emplace();
    table.read("edge", *region.edge);
  }
  return region;
}

// What a region asks for that no triangle has.
std::string why_empty(const RegionRule& rule, const TriMesh& surface, const SurfaceAttributes& attributes) {
  if (rule.half_spaces.empty() && !rule.material.empty() &&
      std::find(attributes.materials.begin(), attributes.materials.end(), rule.material) ==
          attributes.materials.end())
    return attributes.materials.empty()
               ? "the file names no materials (usemtl of OBJ, material_index of faces in PLY)"
               : fmt::format("the file has no material of that name, but {}",
                             fmt::join(attributes.materials, ", "));
  if (rule.half_spaces.empty() && !rule.group.empty() &&
      std::none_of(attributes.groups.begin(), attributes.groups.end(),
                   [&](const std::string& names) { return is_among(names, rule.group); }))
    return attributes.groups.empty() ? "the file names no groups (g or o of OBJ)"
                                     : fmt::format("the file has no group of that name, but {}",
                                                   fmt::join(attributes.groups, ", "));
  if (!rule.half_spaces.empty() && !rule.box && !rule.ball && !rule.indenter && rule.material.empty() &&
      rule.group.empty())
    return fmt::format(
        "none has all three vertices in its half spaces, or an earlier region took them; move "
        "the half spaces ({})",
        reach_text(rule, surface));
  return "none has all three vertices in what it asks for, or an earlier region took them; widen it, take "
         "more "
         "boundary elements (body.remesh), or use `nearest` alone";
}

}  // namespace

void read_regions(const TomlTable& file, Scene& scene) {
  for (const TomlTable& table : file.tables("region")) {
    SceneRegion region = read_region(table);
    for (const SceneRegion& other : scene.regions)
      if (other.rule.name == region.rule.name)
        table.fail("name", fmt::format("the region \"{}\" is already defined at {}; rename one of them",
                                       region.rule.name, other.where));
    if (region.edge && !scene.body.remesh)
      table.fail("edge", "region.edge goes with body.remesh, which makes the boundary elements; add that");
    if (region.edge && (region.rule.nearest || !region.rule.material.empty() || !region.rule.group.empty()))
      table.fail("edge", "region.edge needs a place: half_spaces, box, sphere or indenter alone");
    if (!region.initiation) scene.quiet_regions.push_back(region.rule.name);
    scene.regions.push_back(std::move(region));
  }
}

std::vector<Region> scene_regions(const Scene& scene, const TriMesh& surface,
                                  const std::vector<Region>& model_regions,
                                  const SurfaceAttributes& attributes) {
  std::vector<RegionRule> rules;
  for (const SceneRegion& region : scene.regions)
    rules.push_back(region.rule);
  std::vector<Region> regions = select_regions(surface, rules, attributes);
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i].triangles.empty())
      throw InputError(fmt::format("{}: the region \"{}\" has no triangles: {}", scene.regions[i].where,
                                   regions[i].name, why_empty(rules[i], surface, attributes)));
  const IdVector<TriId, int> taken = region_of_triangles(surface, regions);
  for (Region region : model_regions) {
    if (find_region(regions, region.name)) continue;
    std::erase_if(region.triangles, [&](TriId t) { return taken[t] >= 0; });
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace conchoid
