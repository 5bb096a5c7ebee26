#include "conchoid/formats/formats.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <string_view>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public ::testing::Test {
 protected:
  static std::string message_of(const fs::path& path) {
    return test::refusal([&] { read_mesh(path); });
  }

  test::TemporaryFolder folder_;
};

template <class T>
std::string bytes(T value, std::endian order) {
  std::string raw(sizeof(T), '\0');
  std::memcpy(raw.data(), &value, sizeof(T));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return raw;
}

const std::string tetrahedron_ascii_ply =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
    "float z\n"
    "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

const std::string tetrahedron_off =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

const std::string tetrahedron_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

std::string binary_tetrahedron_ply(std::endian order) {
  std::string file =
      std::string("ply\nformat ") +
      (order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
      " 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty int16 z\n"
      "element face 4\nproperty uchar material\nproperty list ushort uint vertex_index\nend_header\n";
  for (const auto& x : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    file += bytes(static_cast<double>(x[0]), order) + bytes(static_cast<float>(x[1]), order) +
            bytes(static_cast<std::int16_t>(x[2]), order);
  for (const auto& c : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    file += bytes(std::uint8_t{7}, order) + bytes(std::uint16_t{3}, order);
    for (int corner : c)
      file += bytes(static_cast<std::uint32_t>(corner), order);
  }
  return file;
}

void expect_tetrahedron(const TriMesh& mesh) {
  EXPECT_EQ(mesh.node_count(), 4u);
  EXPECT_EQ(mesh.triangle_count(), 4u);
  EXPECT_TRUE(find_defects(mesh).empty());
  EXPECT_NEAR(enclosed_volume(mesh), 1.0 / 6, 1e-15);
}

TEST_F(MeshFiles, DoublePrecisionFormatsReadBackBitForBit) {
  TriMesh mesh = icosphere(1.0 / 3, 2);
  for (const char* name : {"ball.ply", "ball.obj", "ball.off", "BALL.PLY"}) {
    write_mesh(folder_ / name, mesh);
    const TriMesh back = read_mesh(folder_ / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.corners, mesh.corners) << name;
  }
}

TEST_F(MeshFiles, StlReadsBackInSinglePrecisionAsOneClosedSurface) {
  const TriMesh mesh = built_in_model("bar").mesh;
  write_mesh(folder_ / "bar.stl", mesh);
  const TriMesh back = read_mesh(folder_ / "bar.stl");
  EXPECT_EQ(back.node_count(), mesh.node_count());
  ASSERT_EQ(back.triangle_count(), mesh.triangle_count());
  EXPECT_TRUE(find_defects(back).empty());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(back.triangle(TriId(t))[k], mesh.triangle(TriId(t))[k].cast<float>().cast<double>());
}

TEST_F(MeshFiles, HandWrittenFilesOfEveryFlavourAreTheSameTetrahedron) {
  expect_tetrahedron(read_mesh(folder_.write("a.ply", tetrahedron_ascii_ply)));
  expect_tetrahedron(read_mesh(folder_.write("little.ply", binary_tetrahedron_ply(std::endian::little))));
  expect_tetrahedron(read_mesh(folder_.write("big.ply", binary_tetrahedron_ply(std::endian::big))));
  expect_tetrahedron(read_mesh(folder_.write("a.off", tetrahedron_off)));
  expect_tetrahedron(read_mesh(folder_.write("a.obj", tetrahedron_obj)));
  expect_tetrahedron(read_mesh(folder_.write(
      "b.obj",
      "# comment\r\nmtllib x.mtl\r\nv 0 0 0 1.0\r\nv 1 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nvn 0 0 1\r\ng part\r\n"
      "f 1//1 3//1 2//1\r\nf 1/1/1 2/2/2 4/3/3\r\nf -3 -2 -1\r\nf 1 4 3 # last\r\n")));
  std::string stl = "solid tetrahedron\n";
  for (const char* corners :
       {"vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n",
        "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n", "vertex 0 0 0\nvertex 0 0 1\nvertex -0 1e0 0\n"})
    stl += std::string("facet normal 0 0 0\nouter loop\n") + corners + "endloop\nendfacet\n";
  expect_tetrahedron(read_mesh(folder_.write("a.stl", stl + "endsolid tetrahedron\n")));
}

TEST_F(MeshFiles, ConvexPolygonsBecomeFans) {
  const TriMesh cube = read_mesh(
      folder_.write("cube.off",
                    "OFF # a cube of quads\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"));
  EXPECT_EQ(cube.triangle_count(), 12u);
  EXPECT_TRUE(find_defects(cube).empty());
  EXPECT_DOUBLE_EQ(enclosed_volume(cube), 1.0);
}

struct BrokenFile {
  const char* name;
  std::string bytes;
  std::vector<std::string> fragments;  ///< what the message must say
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::vector<BrokenFile> broken_files() {
  const std::string ply = tetrahedron_ascii_ply, little = binary_tetrahedron_ply(std::endian::little);
  std::string nan_ply = little;
  const double nan = std::nan("");
  std::memcpy(nan_ply.data() + nan_ply.find("end_header\n") + 11 + 14, &nan, 8);
  std::string stl(84, '\0');
  stl[80] = 2;
  return {
      {"empty.ply", "", {"empty"}},
      {"foreign.ply", "\x89PNG\r\n\x1a\n", {"does not start with 'ply'"}},
      {"unknown.dae", "x", {"unknown mesh format '.dae'", ".ply, .obj, .stl, .off"}},
      {"header.ply", ply.substr(0, 60), {"line", "truncated"}},
      {"body.ply", ply.substr(0, ply.size() - 12), {"truncated"}},
      {"binary_body.ply", little.substr(0, little.size() - 3), {"face 3", "truncated"}},
      {"nan.ply", replaced(ply, "0 1 0 255", "0 nan 0 255"), {"line 14", "not finite"}},
      {"inf.ply", replaced(ply, "0 1 0 255", "0 1e999 0 255"), {"line 14"}},
      {"binary_nan.ply", nan_ply, {"vertex 1", "not finite"}},
      {"index.ply", replaced(ply, "3 1 2 3", "3 1 2 4"), {"line 18", "face 2", "out of range 0 … 3"}},
      {"negative.ply", replaced(ply, "3 1 2 3", "3 1 -2 3"), {"face 2", "out of range"}},
      {"two_corners.ply", replaced(ply, "3 1 2 3", "2 1 2 3"), {"face 2", "fewer than three"}},
      {"huge.ply", replaced(ply, "vertex 4", "vertex 4000000000000"), {"line 4", "does not fit"}},
      {"negative_count.ply", replaced(ply, "vertex 4", "vertex -4"), {"line 4"}},
      {"type.ply", replaced(ply, "float y", "quad y"), {"line 6", "type"}},
      {"no_y.ply", replaced(ply, "float y", "float w"), {"no property 'y'"}},
      {"points.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
       "z\nend_header\n0 0 0\n",
       {"no element 'face'"}},
      {"strips.ply", replaced(ply, "vertex_indices", "strip_indices"), {"vertex_indices"}},
      {"encoding.ply", replaced(ply, "ascii", "utf8"), {"line 2", "format"}},
      {"letters.ply", replaced(ply, "1 0 0 255", "one 0 0 255"), {"line 13", "'one'", "not a number"}},
      {"long_list.ply", replaced(ply, "3 1 2 3", "999999999 1 2 3"), {"face 2"}},
      {"faces_only.obj", "f 1 2 3\n", {"line 1", "out of range", "0 vertices"}},
      {"no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"no triangles"}},
      {"text.obj", "Dear Sir or Madam\n", {"no vertex lines"}},
      {"index.obj", replaced(tetrahedron_obj, "f 2 3 4", "f 2 3 5"), {"line 7", "index 5", "4 vertices"}},
      {"zero.obj", replaced(tetrahedron_obj, "f 2 3 4", "f 0 3 4"), {"line 7", "index 0"}},
      {"bare.obj", replaced(tetrahedron_obj, "f 2 3 4", "f"), {"line 7", "without vertices"}},
      {"nan.obj", replaced(tetrahedron_obj, "v 1 0 0", "v nan 0 0"), {"line 2", "not finite"}},
      {"missing.obj", replaced(tetrahedron_obj, "v 1 0 0", "v 1 0"), {"line 2", "missing"}},
      {"foreign.off", "solid x\n", {"OFF"}},
      {"truncated.off", tetrahedron_off.substr(0, 40), {"truncated"}},
      {"huge.off", replaced(tetrahedron_off, "4 4 6", "4000000000 4 6"), {"line 2", "does not fit"}},
      {"index.off", replaced(tetrahedron_off, "3 1 2 3", "3 1 2 9"), {"line 9", "index 9", "0 … 3"}},
      {"float_count.off", replaced(tetrahedron_off, "4 4 6", "4.5 4 6"), {"line 2", "whole number"}},
      {"short.stl", "abc", {"too short"}},
      {"truncated.stl", stl, {"2 triangles", "room for 0"}},
      {"ascii_truncated.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
       {"line 4", "endsolid"}},
      {"ascii_letters.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 x 0\nendloop\nendfacet\nendsolid\n",
       {"line 4", "'x'"}},
      {"ascii_quad.stl",
       "solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendsolid\n",
       {"line 7", "4 vertices"}},
      {"ascii_foreign.stl", "solid a\nhello\nendsolid\n", {"line 2", "keyword"}},
  };
}

TEST_F(MeshFiles, BrokenFilesAreRefusedWithPlaceAndRemedy) {
  for (const BrokenFile& broken : broken_files()) {
    const std::string message = message_of(folder_.write(broken.name, broken.bytes));
    EXPECT_NE(message.find(broken.name), std::string::npos) << message;
    for (const std::string& fragment : broken.fragments)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << broken.name << ": '" << fragment << "' not in: " << message;
  }
  EXPECT_NE(message_of(folder_ / "missing.ply").find("check that the file exists"), std::string::npos);
  fs::create_directory(folder_ / "folder.ply");
  EXPECT_NE(message_of(folder_ / "folder.ply").find("folder"), std::string::npos);
}

TEST_F(MeshFiles, FilesCutAnywhereAreRefusedOrReadWhole) {
  const TriMesh mesh = icosphere(1, 0);
  for (const char* name : {"a.ply", "a.stl", "a.off", "a.obj"}) {
    write_mesh(folder_ / name, mesh);
    const std::string whole = folder_.read(name);
    for (std::size_t size = 0; size + 2 < whole.size(); size += 7) {
      const fs::path path = folder_.write(std::string("cut_") + name, whole.substr(0, size));
      if (std::string_view(name) == "a.obj") {  // has no count: may be read up to the cut
        try {
          EXPECT_LT(read_mesh(path).triangle_count(), mesh.triangle_count());
        } catch (const InputError&) {
        }
      } else {
        EXPECT_THROW(read_mesh(path), InputError) << name << " cut at " << size;
      }
    }
  }
}

TEST_F(MeshFiles, DamagedBytesNeverCrash) {
  const TriMesh mesh = icosphere(1, 0);
  std::uint32_t random = 12345;
  auto next = [&] { return random = random * 1664525u + 1013904223u, random >> 8; };
  for (const char* name : {"a.ply", "a.stl", "a.off", "a.obj"}) {
    write_mesh(folder_ / name, mesh);
    const std::string whole = folder_.read(name);
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = whole;
      for (int k = 0; k < 3; ++k)
        damaged[next() % damaged.size()] = static_cast<char>(next());
      const fs::path path = folder_.write(std::string("damaged_") + name, damaged);
      try {
        const TriMesh read = read_mesh(path);
        for (const auto& c : read.corners)
          for (NodeId n : c)
            ASSERT_LT(n.index(), read.node_count());
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("damaged_"), std::string::npos);
      }
    }
  }
}

TEST_F(MeshFiles, NothingIsWrittenWhereThePathIsImpossible) {
  const TriMesh mesh = icosphere(1, 0);
  EXPECT_THROW(write_mesh(folder_ / "none/a.ply", mesh), InputError);
  EXPECT_THROW(write_mesh(folder_ / "a.xyz", mesh), InputError);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

}  // namespace
}  // namespace conchoid
