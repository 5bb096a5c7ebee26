// Binary glTF as exporters write it, put together byte by byte.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  const auto put = [&](std::size_t x) { append_bytes(out, static_cast<std::uint32_t>(x)); };
  put(2);
  put(12 + 8 + json.size() + 8 + binary.size());
  put(json.size());
  out += "JSON" + json;
  put(binary.size());
  out += std::string("BIN\0", 4) + binary;
  return out;
}

/// Replaces every NAME in the text by the number.
std::string with(std::string text, const std::string& name, std::size_t number) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name))
    text.replace(at, name.size(), std::to_string(number));
  return text;
}

/// One mesh under `nodes`: vertices interleaved with normals, as 16-bit indices (none: not indexed).
std::string cube_glb(const std::string& nodes, bool indexed) {
  const TriMesh cube = box_mesh(Vec3(1, 1, 1), 2, 2, 2);
  std::string binary;
  std::size_t vertices = 0;
  for (std::size_t t = 0; t < cube.triangle_count(); ++t)
    for (const Vec3& x : cube.triangle(TriId(t))) {
      for (const Vec3& v : {x, unit_normal(cube, TriId(t))})
        for (const double c : v)
          append_bytes(binary, static_cast<float>(c));
      ++vertices;
    }
  const std::size_t index_at = binary.size();
  for (std::size_t i = 0; i < vertices; ++i)
    append_bytes(binary, static_cast<std::uint16_t>(i));
  std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":" + nodes +
      ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}" +
      (indexed ? ",\"indices\":2" : "") +
      "}]}],\"accessors\":["
      "{\"bufferView\":0,\"componentType\":5126,\"count\":NV,\"type\":\"VEC3\"},"
      "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":NV,\"type\":\"VEC3\"},"
      "{\"bufferView\":1,\"componentType\":5123,\"count\":NV,\"type\":\"SCALAR\"}],"
      "\"bufferViews\":[{\"buffer\":0,\"byteLength\":IX,\"byteStride\":24},"
      "{\"buffer\":0,\"byteOffset\":IX,\"byteLength\":LI}],\"buffers\":[{\"byteLength\":SIZE}]}";
  return glb(
      with(with(with(with(json, "NV", vertices), "IX", index_at), "LI", 2 * vertices), "SIZE", binary.size()),
      binary);
}

/// A tetrahedron without indices in the given mode: the vertices in their order.
std::string tetrahedron_glb(const std::vector<std::vector<int>>& primitives, int mode) {
  const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::string binary, accessors, views, list;
  for (const std::vector<int>& vertices : primitives) {
    const std::size_t at = binary.size(), i = static_cast<std::size_t>(&vertices - primitives.data());
    for (const int v : vertices)
      for (const double c : corner[static_cast<std::size_t>(v)])
        append_bytes(binary, static_cast<float>(c));
    const std::string comma = i > 0 ? "," : "";
    accessors += comma + "{\"bufferView\":" + std::to_string(i) +
                 ",\"componentType\":5126,\"count\":" + std::to_string(vertices.size()) +
                 ",\"type\":\"VEC3\"}";
    views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(at) +
             ",\"byteLength\":" + std::to_string(binary.size() - at) + "}";
    list += comma + "{\"attributes\":{\"POSITION\":" + std::to_string(i) +
            "},\"mode\":" + std::to_string(mode) + "}";
  }
  return glb("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[" +
                 list + "]}],\"accessors\":[" + accessors + "],\"bufferViews\":[" + views +
                 "],\"buffers\":[{\"byteLength\":" + std::to_string(binary.size()) + "}]}",
             binary);
}

class Glb : public ::testing::Test {
 protected:
  TriMesh read(const std::string& bytes) { return read_mesh(folder_.write("a.glb", bytes)); }
  test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(Glb, InterleavedVerticesIndexedAndNot) {
  for (const bool indexed : {true, false}) {
    const TriMesh mesh = read(cube_glb("[{\"mesh\":0}]", indexed));
    EXPECT_EQ(mesh.triangle_count(), 48u);
    EXPECT_EQ(mesh.node_count(), 26u) << "vertices at one place are one node";
    EXPECT_TRUE(find_defects(mesh).empty());
    EXPECT_NEAR(enclosed_volume(mesh), 1, 1e-12);
  }
}

TEST_F(Glb, NodesPutTheirMeshesInPlace) {
  const std::string nodes =
      "[{\"children\":[1,2],\"translation\":[10,0,0]},"
      "{\"mesh\":0,\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],\"scale\":[2,1,1],"
      "\"translation\":[0,5,0]},"
      "{\"mesh\":0,\"matrix\":[-1,0,0,0, 0,1,0,0, 0,0,3,0, -5,0,0,1]}]";
  const TriMesh mesh = read(cube_glb(nodes, true));
  EXPECT_TRUE(find_defects(mesh).empty()) << "the mirrored one looks outward, too";
  EXPECT_NEAR(enclosed_volume(mesh), 2 + 3, 1e-9);
  const Box box = bounding_box(mesh);
  EXPECT_NEAR((box.low - Vec3(4.5, -0.5, -1.5)).norm(), 0, 1e-9);
  EXPECT_NEAR((box.high - Vec3(10.5, 6, 1.5)).norm(), 0, 1e-9)
      << "turned by 90° about z after it was stretched";
}

TEST_F(Glb, StripsAndFans) {
  const TriMesh strip = read(tetrahedron_glb({{0, 2, 1, 3, 0, 2}}, 5));
  EXPECT_TRUE(find_defects(strip).empty());
  EXPECT_NEAR(enclosed_volume(strip), 1.0 / 6, 1e-12);
  const TriMesh fan = read(tetrahedron_glb({{0, 2, 1, 3, 2}, {1, 2, 3}}, 6));
  EXPECT_TRUE(find_defects(fan).empty());
  EXPECT_NEAR(enclosed_volume(fan), 1.0 / 6, 1e-12);
}

TEST_F(Glb, NormalsComeAlong) {
  const AttributedMesh surface =
      read_surface(folder_.write("a.glb", cube_glb("[{\"mesh\":0,\"scale\":[1,-1,4]}]", true)));
  ASSERT_EQ(surface.attributes.normal.size(), surface.mesh.triangle_count());
  for (std::size_t t = 0; t < surface.mesh.triangle_count(); ++t)
    for (const Vec3& n : surface.attributes.normal[t])
      EXPECT_NEAR((n - unit_normal(surface.mesh, TriId(t))).norm(), 0, 1e-6);
}

TEST_F(Glb, DamagedFilesAreRefused) {
  const std::string good = cube_glb("[{\"mesh\":0}]", true);
  const auto refused = [&](const std::string& bytes) { return test::refusal([&] { read(bytes); }); };
  EXPECT_NE(refused("PK\3\4 and so on, and so on").find("glTF"), std::string::npos);
  EXPECT_NE(refused(good.substr(0, good.size() - 8)).find("truncated"), std::string::npos);
  EXPECT_NE(refused(cube_glb("[{\"mesh\":7}]", true)).find("no entry 7"), std::string::npos);
  EXPECT_NE(refused(cube_glb("[{\"mesh\":0,\"children\":[0]}]", true)).find("own children"),
            std::string::npos);
  EXPECT_NE(refused(tetrahedron_glb({{0, 1, 2}}, 1)).find("no triangles"), std::string::npos);
  std::uint32_t random = 12345;
  const auto next = [&] { return random = random * 1664525u + 1013904223u, random >> 8; };
  for (int trial = 0; trial < 500; ++trial) {
    std::string damaged = good;
    for (int k = 0; k < 3; ++k)
      damaged[next() % 1200] = static_cast<char>(next());
    try {
      read(damaged);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a.glb"), std::string::npos);
    }
  }
}

}  // namespace conchoid
