#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "conchoid/formats/formats.hpp"
#include "conchoid/io/fragments_io.hpp"
#include "conchoid/surface/fragment_attributes.hpp"
#include "intersect/cut_shapes.hpp"
#include "io/program_output.hpp"
#include "io/samples.hpp"

// What Blender makes of the files, where it is installed.
using namespace conchoid;

namespace {

bool is_there() {
  return result_of("blender --version 2>/dev/null").first == 0;
}

/// The objects of each file as tests/blender/import.py describes them.
std::vector<nlohmann::json> import(const std::vector<std::filesystem::path>& files) {
  std::string command =
      std::string("blender --background --factory-startup --python-exit-code 3 --python '") +
      CONCHOID_SOURCE_DIR + "/tests/blender/import.py' --";
  for (const auto& file : files)
    command += " '" + file.string() + "'";
  const auto [status, text] = result_of(command + " 2>&1");
  EXPECT_EQ(status, 0) << text;
  std::vector<nlohmann::json> out;
  std::istringstream lines(text);
  const std::string marker = "IMPORTED ";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(marker)) out.push_back(nlohmann::json::parse(line.substr(marker.size())));
  EXPECT_EQ(out.size(), files.size()) << text;
  return out;
}

std::map<std::string, int> faces_by_material(const Fragment& f) {
  std::map<std::string, int> count;
  for (const int m : f.attributes.material)
    ++count[f.attributes.materials[static_cast<std::size_t>(m)]];
  return count;
}

std::map<std::string, int> faces_by_material(const nlohmann::json& object) {
  std::map<std::string, int> count;
  for (std::size_t i = 0; i < object["materials"].size(); ++i)
    if (const int n = object["counts"][i]; n > 0) {
      const std::string name = object["materials"][i];
      count[name.substr(0, name.find('.'))] += n;  // "fracture.001" is the second of that name in one scene
    }
  return count;
}

void expect_same(const nlohmann::json& object, const Fragment& f, bool with_materials) {
  EXPECT_EQ(object["triangles"], f.mesh.triangle_count());
  EXPECT_NEAR(object["volume"].get<double>(), enclosed_volume(f.mesh), 1e-5 * enclosed_volume(f.mesh));
  if (!with_materials) return;
  EXPECT_EQ(faces_by_material(object), faces_by_material(f));
  EXPECT_EQ(object["uv"], 1);
}

std::vector<Fragment> painted_pieces() {
  const TriMesh body = shapes::icosphere(2);
  const auto wave = shapes::sheet(-1.3, 1.3, -1.3, 1.3, 12, 12, [](double u, double v) {
    return Vec3(u, v, 0.1 * std::sin(5 * u) + 0.2 * v);
  });
  const auto wall =
      shapes::sheet(-1.3, 1.3, -1.3, 1.3, 7, 7, [](double u, double v) { return Vec3(0.1 * u, u, v); });
  auto pieces = cut_into_fragments(body, {wave, wall}, {});
  SurfaceAttributes paint;
  paint.materials = {"north", "south"};
  for (std::size_t t = 0; t < body.triangle_count(); ++t)
    paint.material.push_back(centroid(body, TriId(t)).z() > 0 ? 0 : 1);
  transfer_attributes(pieces, body, paint, {});
  return pieces;
}

}  // namespace

TEST(Blender, ImportsPiecesWithCountsVolumesAndMaterials) {
  if (!is_there()) GTEST_SKIP() << "Blender is not installed";
  const TemporaryFolder folder;
  const std::vector<Fragment> pieces = painted_pieces();
  ASSERT_EQ(pieces.size(), 4u);
  write_fragments_glb(folder / "f.glb", pieces, fragment_contacts(pieces));
  std::vector<std::filesystem::path> files{folder / "f.glb"};
  for (const char* kind : {"obj", "ply", "stl"})
    files.push_back(folder / ("f." + std::string(kind)));
  write_fragment_obj(files[1], pieces[1]);
  write_fragment_ply(files[2], pieces[1]);
  write_mesh(files[3], pieces[1].mesh);
  const auto seen = import(files);
  ASSERT_EQ(seen.size(), 4u);
  ASSERT_EQ(seen[0].size(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    expect_same(seen[0][i], pieces[i], true);
  for (std::size_t k = 1; k < 4; ++k) {
    ASSERT_EQ(seen[k].size(), 1u) << files[k];
    expect_same(seen[k][0], pieces[1], k == 1);
  }
}
