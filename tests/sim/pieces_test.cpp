#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "conchoid/sim/run.hpp"
#include "intersect/cut_shapes.hpp"
#include "scenes.hpp"

// From a body with materials and texture coordinates to its pieces.
namespace conchoid {
namespace {

using test::TemporaryFolder;

/// A cube far from the origin, by hand as an .obj: two materials, a texture chart for each face.
TriMesh write_textured_cube(const std::filesystem::path& path) {
  TriMesh mesh = shapes::cube(3);
  for (Vec3& x : mesh.positions)
    x = 0.3 * x + Vec3(12.3, -45.6, 78.9);
  std::ofstream out(path);
  for (const Vec3& x : mesh.positions)
    out << "v " << test::text(x[0]) << ' ' << test::text(x[1]) << ' ' << test::text(x[2]) << '\n';
  for (int i = 0; i < 4; ++i)
    out << "vt " << 0.125 * i << ' ' << 0.25 * i * i << '\n';
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto& c = mesh.corners[TriId(t)];
    out << (t % 2 == 0 ? "usemtl glaze\n" : "usemtl clay\n") << 'f';
    for (std::size_t k = 0; k < 3; ++k)
      out << ' ' << c[k].value + 1 << '/' << 1 + (t + k) % 4;
    out << '\n';
  }
  return mesh;
}

TEST(Pieces, KeepTheBitsMaterialsAndTextureOfTheBody) {
  const TemporaryFolder folder;
  const TriMesh body = write_textured_cube(folder.path() / "cube.obj");
  Scene scene = parse_scene("[body]\nmesh = \"cube.obj\"\n" + test::material_text() +
                                "[resolution]\ncrack = 0.06\nsurface = 0.02\n"
                                "[[crack]]\nkind = \"rectangle\"\ncenter = [12.31, -45.62, 78.9]\n"
                                "edges = [[0.42, 0.0, 0.0], [0.0, 0.42, 0.0]]\n[run]\nframes = 1\n",
                            "scene.toml", folder.path());
  RunOptions options;
  options.progress = false;
  options.folder = folder.path() / "run";
  options.formats = {"glb", "stl", "vdb", "hulls"};
  const RunResult result = run_scene(scene, options);
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_EQ(result.fragments.size(), 2u);
  ASSERT_EQ(result.document.contacts.size(), 1u);
  EXPECT_NEAR(result.document.contacts[0].area, 0.09, 1e-12);  // the cube's cross section

  const auto key = [](const Vec3& x) { return std::array{x[0], x[1], x[2]}; };
  std::set<std::array<double, 3>> nodes, found;
  for (const Vec3& x : body.positions)
    nodes.insert(key(x));
  for (const Fragment& f : result.fragments) {
    EXPECT_EQ(f.attributes.materials, (std::vector<std::string>{"glaze", "clay", "fracture"}));
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      const bool fracture = f.face_kind[t] == FaceKind::fracture;
      EXPECT_EQ(f.attributes.material[t], fracture ? 2 : f.source[t].value % 2);
      if (fracture) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& x = f.mesh.positions[f.mesh.corners[TriId(t)][k]];
        if (!nodes.contains(key(x))) continue;
        found.insert(key(x));
        for (std::size_t j = 0; j < 3; ++j)
          if (body.positions[body.corners[f.source[t]][j]] == x) {
            const auto number = static_cast<double>((f.source[t].index() + j) % 4);
            EXPECT_EQ(f.attributes.uv[t][k], Vec2(0.125 * number, 0.25 * number * number));
          }
      }
    }
  }
  EXPECT_EQ(found, nodes);  // bit for bit

  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "run"))
    if (entry.is_regular_file() && entry.path().parent_path().filename() != "frames")
      files.insert(entry.path().filename().string());
  EXPECT_EQ(files,
            (std::set<std::string>{"crack.ply", "fragment_000.stl", "fragment_001.stl", "fragments.glb",
                                   "fragments.vdb", "front.csv", "hulls.obj", "run.json", "run.pvd"}));
  EXPECT_TRUE(read_run(folder.path() / "run").fragments.empty());
}

TEST(Pieces, NoMoreThanTheSceneAllows) {
  const Scene scene =
      parse_scene("[body]\nmodel = \"cube\"\n" + test::material_text() +
                      "[resolution]\ncrack = 0.2\nsurface = 0.1\n"
                      "[[crack]]\nkind = \"rectangle\"\ncenter = [0.0, 0.0, 0.21]\n"
                      "edges = [[1.4, 0.0, 0.0], [0.0, 1.4, 0.0]]\n"
                      "[[crack]]\nkind = \"rectangle\"\ncenter = [0.0, 0.0, -0.12]\n"
                      "edges = [[1.4, 0.0, 0.0], [0.0, 1.4, 0.0]]\n[run]\nframes = 1\nmax_fragments = 2\n",
                  "scene.toml", "");
  RunOptions options;
  options.progress = false;
  const RunResult result = run_scene(scene, options);
  ASSERT_EQ(result.fragments.size(), 2u);  // 0.38 below; 0.33 in the middle takes 0.29 above
  EXPECT_NEAR(result.fragments[0].volume, 0.62, 1e-12);
  EXPECT_NEAR(result.fragments[1].volume, 0.38, 1e-12);
}

}  // namespace
}  // namespace conchoid
