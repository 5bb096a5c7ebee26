#pragma once

#include <fmt/core.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "arbitrary_rotation.hpp"
#include "conchoid/core/vec.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/sim/scene.hpp"
#include "temporary_folder.hpp"

// Scenes of the tests as text, the way a user writes them.
namespace conchoid::test {

/// Writes the mesh into the folder and returns the file's path as a scene names it.
inline std::string write_mesh_in(const TemporaryFolder& folder, const std::string& name,
                                 const TriMesh& mesh) {
  write_mesh(folder / name, mesh);
  return (folder / name).string();
}

/// Shortest text that reads back bit for bit.
inline std::string text(double x) {
  return fmt::format("{}", x);
}
inline std::string text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

struct Material {
  double E = 3.1e9, nu = 0.327, strength = 7.6e7, toughness = 1e6;
};

inline std::string material_text(const Material& m = {}) {
  return fmt::format("[material]\nyoungs_modulus = {}\npoisson_ratio = {}\nstrength = {}\ntoughness = {}\n",
                     m.E, m.nu, m.strength, m.toughness);
}
inline std::string mesh_body_text(const std::string& file) {
  return fmt::format("[body]\nmesh = '{}'\n", file);
}
inline std::string resolution_text(double crack, double surface) {
  return fmt::format("[resolution]\ncrack = {}\nsurface = {}\n", crack, surface);
}
inline std::string half_space_text(const Vec3& normal, double offset) {
  return fmt::format("[{}, {}, {}, {}]", normal[0], normal[1], normal[2], offset);
}
/// @param half_spaces  "[nx, ny, nz, d], …"
inline std::string region_text(const std::string& name, const std::string& half_spaces) {
  return fmt::format("[[region]]\nname = '{}'\nhalf_spaces = [{}]\n", name, half_spaces);
}
/// @param key  "traction", "displacement" or "force"
inline std::string boundary_text(const std::string& region, const std::string& key, const Vec3& value) {
  return fmt::format("[[boundary]]\nregion = '{}'\n{} = {}\n", region, key, text(value));
}
inline std::string remote_stress_text(const Mat3& s) {
  return fmt::format("[remote_stress]\ntensor = [{}, {}, {}, {}, {}, {}]\n", s(0, 0), s(1, 1), s(2, 2),
                     s(1, 2), s(0, 2), s(0, 1));
}
inline std::string mesh_crack_text(const std::string& file) {
  return fmt::format("[[crack]]\nkind = 'mesh'\nfile = '{}'\n", file);
}

/// The cube with a disc crack in its middle, pulled apart across it: it comes apart.
/// @param fields  tables of the material, if any
inline std::string cracked_cube_text(const std::string& fields, double crack, double surface) {
  return "[body]\nmodel = 'cube'\n" + material_text() + fields + resolution_text(crack, surface) +
         "[[crack]]\nkind = 'disc'\ncenter = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\nradius = 0.2\n" +
         boundary_text("z+", "traction", {0, 0, 1e7}) + boundary_text("z-", "traction", {0, 0, -1e7}) +
         "[run]\nmax_cracks = 0\n";
}

/// The cube pulled apart askew by its ends: a crack starts and cuts it in two.
inline std::string pulled_cube_text() {
  return "[body]\nmodel = 'cube'\n" + material_text() + resolution_text(0.1, 0.02) +
         boundary_text("z+", "traction", {3e7, 1e7, 9e7}) +
         boundary_text("z-", "traction", {-3e7, -1e7, -9e7}) + "[run]\ninertia_relief = true\n";
}

inline Scene scene_from_text(const std::string& text) {
  return parse_scene(text, "scene.toml", std::filesystem::temp_directory_path());
}

}  // namespace conchoid::test
