#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "conchoid/io/fragments_io.hpp"
#include "conchoid/surface/fragment_attributes.hpp"
#include "intersect/cut_shapes.hpp"
#include "io/program_output.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

const std::filesystem::path validator = std::filesystem::path(CONCHOID_SOURCE_DIR) / "tests/gltf";

/// What a program writes to stdout; nothing if it fails.
std::string output_of(const std::string& command) {
  const auto [status, text] = result_of(command);
  return status == 0 ? text : std::string();
}

bool is_there() {
  return std::filesystem::exists(validator / "node_modules/gltf-validator") &&
         !output_of("node --version 2>/dev/null").empty();
}

void expect_valid(const std::vector<Fragment>& pieces) {
  const TemporaryFolder folder;
  write_fragments_glb(folder / "f.glb", pieces, fragment_contacts(pieces));
  const auto report = nlohmann::json::parse(output_of("node '" + (validator / "validate.mjs").string() +
                                                      "' '" + (folder / "f.glb").string() + "'"));
  EXPECT_EQ(report["issues"]["numErrors"], 0) << report["issues"].dump(1);
  EXPECT_EQ(report["issues"]["numWarnings"], 0) << report["issues"].dump(1);
  std::size_t triangles = 0;
  for (const Fragment& f : pieces)
    triangles += f.mesh.triangle_count();
  EXPECT_EQ(report["info"]["totalTriangleCount"], triangles);
}

}  // namespace

TEST(GltfValidator, AcceptsPieces) {
  if (!is_there()) GTEST_SKIP() << "run 'npm ci' in tests/gltf (needs nodejs and npm)";
  expect_valid(broken_cube(0.1));
  const TriMesh body = shapes::icosphere(3);
  const auto wave = shapes::sheet(-1.3, 1.3, -1.3, 1.3, 20, 20, [](double u, double v) {
    return Vec3(u, v, 0.1 * std::sin(5 * u) + 0.2 * v);
  });
  const auto wall =
      shapes::sheet(-1.3, 1.3, -1.3, 1.3, 9, 9, [](double u, double v) { return Vec3(0.1 * u, u, v); });
  auto pieces = cut_into_fragments(body, {wave, wall}, {});
  SurfaceAttributes paint;
  paint.materials = {"north", "south"};
  for (std::size_t t = 0; t < body.triangle_count(); ++t) {
    paint.material.push_back(centroid(body, TriId(t)).z() > 0 ? 0 : 1);
    const Triangle x = body.triangle(TriId(t));
    paint.normal.push_back({x[0], x[1], x[2]});
  }
  transfer_attributes(pieces, body, paint, {});
  expect_valid(pieces);
}
