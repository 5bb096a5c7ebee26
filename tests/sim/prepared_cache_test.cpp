// Prepared bodies out of a cache: the same bits, and nothing that depends on the body is made twice.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

Scene scene_of(const std::string& body, const std::string& boundary, const fs::path& cache) {
  Scene scene = parse_scene(
      body + test::material_text() + test::resolution_text(0.2, 0.05) + boundary + "[run]\nframes = 3\n",
      "scene.toml", ".");
  if (!cache.empty()) scene.run.cache = std::make_shared<const ByteCache>(cache);
  return scene;
}

std::string pulled(double stress, bool held) {
  return test::boundary_text("z+", "traction", Vec3(0, 0, stress)) +
         (held ? std::string("[[boundary]]\nregion = 'z-'\nfixed = true\n")
               : test::boundary_text("z-", "traction", Vec3(0, 0, -stress)));
}

std::string hash_of(const Scene& scene) {
  RunOptions options;
  options.progress = false;
  return run_scene(scene, options).document.hash;
}

std::map<std::string, fs::file_time_type> files_in(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename()] = entry.last_write_time();
  return files;
}

}  // namespace

TEST(PreparedCache, ARunHasTheSameBitsWithAndWithoutIt) {
  const TemporaryFolder folder;
  const std::string cube = "[body]\nmodel = 'cube'\n";
  for (const bool held : {false, true}) {
    const fs::path cache = folder / (held ? "held" : "free");
    const std::string plain = hash_of(scene_of(cube, pulled(1e8, held), {}));
    EXPECT_EQ(hash_of(scene_of(cube, pulled(1e8, held), cache)), plain) << "made";
    const auto made = files_in(cache);
    EXPECT_EQ(made.size(), 2u) << "factors and columns; those of pieces are not kept";
    EXPECT_EQ(hash_of(scene_of(cube, pulled(1e8, held), cache)), plain) << "recalled";
    EXPECT_EQ(hash_of(scene_of(cube, pulled(1.1e8, held), cache)),
              hash_of(scene_of(cube, pulled(1.1e8, held), {})))
        << "under another load";
    EXPECT_EQ(files_in(cache), made) << "nothing was made again";
  }
}

TEST(PreparedCache, SoAreQuadraticElements) {
  const TemporaryFolder folder;
  const auto scene = [&](const fs::path& cache) {
    Scene out = scene_of("[body]\nmodel = 'cube'\n", pulled(1e8, true), cache);
    out.run.elements = ElementOrder::quadratic;
    return out;
  };
  const std::string plain = hash_of(scene({}));
  EXPECT_EQ(hash_of(scene(folder / "cache")), plain) << "made";
  const auto made = files_in(folder / "cache");
  EXPECT_EQ(made.size(), 2u) << "factors of both kinds";
  EXPECT_EQ(hash_of(scene(folder / "cache")), plain) << "recalled";
  EXPECT_EQ(files_in(folder / "cache"), made) << "nothing was made again";
}

TEST(PreparedCache, AnotherMaterialResolutionOfElementsOrSupportIsAnotherBody) {
  const TemporaryFolder folder;
  const std::string cube = "[body]\nmodel = 'cube'\n";
  const auto made = [&] { return files_in(folder / "cache").size(); };
  const Scene first = scene_of(cube, pulled(1e8, false), folder / "cache");
  prepare(first);
  EXPECT_EQ(made(), 2u);
  Scene softer = first;
  softer.material.youngs_modulus *= 0.5;
  prepare(softer);
  EXPECT_EQ(made(), 4u);
  Scene finer = first;
  finer.run.quadrature_tolerance = 1e-5;
  prepare(finer);
  EXPECT_EQ(made(), 6u);
  prepare(scene_of(cube, pulled(1e8, true), folder / "cache"));
  EXPECT_EQ(made(), 8u);
  Scene finer_crack = first;
  finer_crack.resolution.crack = 0.15;
  prepare(finer_crack);
  EXPECT_EQ(made(), 8u) << "the crack's resolution is none of the body's";
}

TEST(PreparedCache, DamagedFilesAreMadeAgain) {
  const TemporaryFolder folder;
  const Scene scene = scene_of("[body]\nmodel = 'cube'\n", pulled(1e8, false), folder / "cache");
  const std::string plain = hash_of(scene);
  for (const auto& [name, time] : files_in(folder / "cache")) {
    const std::string bytes = read_bytes(folder / "cache" / name);
    std::ofstream(folder / "cache" / name, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  }
  EXPECT_EQ(hash_of(scene), plain);
  EXPECT_EQ(hash_of(scene), plain);
}

TEST(PreparedCache, RemeshedSurfacesAreKept) {
  const TemporaryFolder folder;
  const std::string file = test::write_mesh_in(folder, "body.ply", built_in_model("cylinder").mesh);
  const std::string body = test::mesh_body_text(file) + "remesh = 120\n";
  const auto mesh = [&](const fs::path& cache) { return scene_body(scene_of(body, "", cache)).surface; };
  const TriMesh plain = mesh({});
  for (int i = 0; i < 2; ++i) {
    const TriMesh kept = mesh(folder / "cache");
    EXPECT_EQ(kept.positions, plain.positions);
    EXPECT_EQ(kept.corners, plain.corners);
    EXPECT_EQ(files_in(folder / "cache").size(), 2u) << "that it is sound, and what was made of it";
  }
}

TEST(PreparedCache, OnlySoundSurfacesAreTakenOnTrust) {
  const TemporaryFolder folder;
  const fs::path cache = folder / "cache";
  TriMesh mesh = built_in_model("cylinder").mesh;
  const auto take = [&] {
    const std::string file = test::write_mesh_in(folder, "body.ply", mesh);
    return scene_body(scene_of(test::mesh_body_text(file), "", cache)).surface.triangle_count();
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(take(), mesh.triangle_count());
    EXPECT_EQ(files_in(cache).size(), 1u);
  }
  mesh.corners.pop_back();
  for (int i = 0; i < 2; ++i) {
    EXPECT_THROW(take(), InputError);
    EXPECT_EQ(files_in(cache).size(), 1u);
  }
}

}  // namespace conchoid
