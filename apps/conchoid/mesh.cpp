#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {
namespace {

struct MeshCommand {
  std::string scene, out;
};

void mesh_and_print(const MeshCommand& command, const CommonOptions& common) {
  const Scene scene = read_scene(command.scene);
  const TriMesh mesh = scene_body(scene).surface;
  if (mesh.corners.empty())
    throw InputError(scene.body.where + ": the infinite body has no surface to write; choose another model");
  write_mesh(command.out, mesh);
  const double volume = enclosed_volume(mesh), area = surface_area(mesh);
  if (common.json) {
    const nlohmann::ordered_json json = {{"file", command.out},
                                         {"triangles", mesh.triangle_count()},
                                         {"nodes", mesh.node_count()},
                                         {"area", area},
                                         {"volume", volume}};
    return print(json.dump());
  }
  print(fmt::format("{}: {} triangles, {} nodes, area {:.6g} m², volume {:.6g} m³", command.out,
                    mesh.triangle_count(), mesh.node_count(), area, volume));
}

}  // namespace

void add_mesh(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<MeshCommand>();
  CLI::App* command =
      add_command(program, invocation, "mesh", "Write the boundary element mesh that a scene produces",
                  [options, &invocation] { mesh_and_print(*options, invocation.common); });
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("--out", options->out, "mesh file: .ply, .obj, .stl or .off")->required();
}

}  // namespace conchoid
