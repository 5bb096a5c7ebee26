#include <fmt/format.h>

#include <Eigen/Core>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/scene_parser.hpp"

namespace conchoid {
namespace {

FieldPlacement read_placement(const TomlTable& table, const std::string& name) {
  FieldPlacement placement;
  if (table.has("origin")) {
    placement.origin = Vec3::Zero();
    table.read("origin", *placement.origin);
  }
  placement.axes = read_axes(table, name);
  return placement;
}

Layers read_layers(const TomlTable& table, const std::string& name) {
  Layers layers;
  table.read("direction", layers.direction);
  if (layers.direction.isZero(0))
    table.fail("direction", fmt::format("{}.direction is (0, 0, 0); give a direction", name));
  layers.direction /= layers.direction.norm();
  table.require("wavelength", layers.wavelength);
  table.require("amplitude", layers.amplitude);
  if (layers.amplitude >= 1)
    table.fail("amplitude",
               fmt::format("{}.amplitude is {}, but of layers it must be < 1, or the factor is not positive",
                           name, layers.amplitude));
  table.read("phase", layers.phase);
  return layers;
}

Noise read_noise(const TomlTable& table) {
  Noise noise;
  table.require("wavelength", noise.wavelength);
  table.require("amplitude", noise.amplitude);
  table.read("octaves", noise.octaves);
  table.read("gain", noise.gain);
  table.read("seed", noise.seed);
  return noise;
}

Grains read_grains(const TomlTable& table, const std::string& name) {
  Grains grains;
  table.require("size", grains.size);
  table.read("stretch", grains.stretch);
  grains.width = grains.size / 5;
  table.read("width", grains.width);
  if (grains.width < grains.size / 50 || grains.width > grains.size)
    table.fail("width", fmt::format("{}.width is {} m, but must be from {} m to {} m: size / 50 … size", name,
                                    grains.width, grains.size / 50, grains.size));
  grains.weakening = 0.5;
  table.read("weakening", grains.weakening);
  table.read("spread", grains.spread);
  table.read("seed", grains.seed);
  return grains;
}

Voxels read_voxels(const TomlTable& table, const std::filesystem::path& folder) {
  Voxels voxels;
  const std::filesystem::path file = existing_file(table, "file", folder);
  std::string grid, outside = "clamped";
  table.read("grid", grid);
  table.read("scale", voxels.scale);
  table.read("outside", outside);
  voxels.outside = outside == "clamped" ? Outside::clamped : Outside::periodic;
  try {
    voxels.grid = read_vdb(file, grid);
  } catch (const InputError& error) {
    table.fail(grid.empty() ? "file" : "grid", error.what());
  }
  return voxels;
}

}  // namespace

std::vector<FieldFactor> read_material_field(const TomlTable& material, std::string_view key,
                                             const std::filesystem::path& folder) {
  const std::string name = fmt::format("material.{}", key);
  std::vector<FieldFactor> factors;
  for (const TomlTable& table : material.one_or_more(key)) {
    table.require_known_keys();
    std::string kind;
    table.require("kind", kind);
    require_keys_of_kind(table, name, kind,
                         {{"origin", {"layers", "grains", "noise", "vdb"}},
                          {"axes", {"layers", "grains", "noise", "vdb"}},
                          {"direction", {"layers"}},
                          {"wavelength", {"layers", "noise"}},
                          {"amplitude", {"layers", "noise"}},
                          {"phase", {"layers"}},
                          {"octaves", {"noise"}},
                          {"gain", {"noise"}},
                          {"seed", {"grains", "noise"}},
                          {"size", {"grains"}},
                          {"stretch", {"grains"}},
                          {"weakening", {"grains"}},
                          {"width", {"grains"}},
                          {"spread", {"grains"}},
                          {"file", {"vdb"}},
                          {"grid", {"vdb"}},
                          {"scale", {"vdb"}},
                          {"outside", {"vdb"}}});
    FieldFactor factor{Layers{}, read_placement(table, name)};
    if (kind == "homogeneous") continue;
    if (kind == "layers") factor.kind = read_layers(table, name);
    if (kind == "grains") factor.kind = read_grains(table, name);
    if (kind == "noise") factor.kind = read_noise(table);
    if (kind == "vdb") factor.kind = read_voxels(table, folder);
    factors.push_back(std::move(factor));
  }
  return factors;
}

}  // namespace conchoid
