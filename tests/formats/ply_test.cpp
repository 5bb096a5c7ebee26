#include "conchoid/formats/ply.hpp"

#include <gtest/gtest.h>

#include "conchoid/mesh/crack_meshes.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

using namespace conchoid;
using test::TemporaryFolder;

namespace {

/// An open mesh whose coordinates have no short decimals.
TriMesh disc(int triangles) {
  return disc_crack({0.1, 0.2, 1.0 / 3.0}, {1, 1, 2}, 0.3, {.triangles = triangles});
}

std::string refusal(const std::filesystem::path& path) {
  return test::refusal([&] { read_ply(path); });
}

}  // namespace

TEST(Ply, AllPropertiesComeBack) {
  const TemporaryFolder folder;
  PlyMesh ply;
  ply.mesh = disc(24);
  for (std::size_t n = 0; n < ply.mesh.node_count(); ++n)
    ply.node_normal.push_back(n % 2 ? Vec3::UnitX() : Vec3::UnitZ());
  for (std::size_t t = 0; t < ply.mesh.triangle_count(); ++t) {
    const double x = static_cast<double>(t) / 64;
    ply.color.push_back({1, 2, 255});
    ply.kind.push_back(t % 2);
    ply.source.push_back(t == 5 ? -1 : static_cast<int>(t * 7));
    ply.frame.push_back(static_cast<int>(t) / 4);
    ply.attributes.material.push_back(t < 8 ? 0 : 1);
    ply.attributes.uv.push_back({Vec2(x, 0), Vec2(0, x), Vec2(x, 1)});
    ply.attributes.normal.push_back({Vec3::UnitZ(), Vec3::UnitY(), Vec3::Zero()});
  }
  write_ply(folder / "m.ply", ply);
  const PlyMesh back = read_ply(folder / "m.ply");
  EXPECT_EQ(back.mesh.positions, ply.mesh.positions);  // bit for bit
  EXPECT_EQ(back.mesh.corners, ply.mesh.corners);
  EXPECT_EQ(back.node_normal, ply.node_normal);
  EXPECT_EQ(back.kind, ply.kind);
  EXPECT_EQ(back.source, ply.source);
  EXPECT_EQ(back.frame, ply.frame);
  EXPECT_EQ(back.attributes.material, ply.attributes.material);
  EXPECT_EQ(back.attributes.materials, (std::vector<std::string>{"material_0", "material_1"}));
  EXPECT_EQ(back.attributes.uv, ply.attributes.uv);
  EXPECT_EQ(back.attributes.normal, ply.attributes.normal);
}

TEST(Ply, TagsOfAPolygonBelongToAllItsTriangles) {
  const PlyMesh ply = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty int frame\nproperty list uchar int vertex_indices\nproperty float kind\n"
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n7 4 0 1 2 3 0.5\n-2 3 2 1 0 0.5\n",
      "m.ply");
  EXPECT_EQ(ply.frame, (std::vector<int>{7, 7, -2}));
  EXPECT_TRUE(ply.kind.empty()) << "a number with a fraction is somebody else's property";
}

TEST(Ply, AnEmptyCrackIsAMesh) {
  const TemporaryFolder folder;
  write_ply(folder / "m.ply", {});
  EXPECT_EQ(read_ply(folder / "m.ply").mesh.triangle_count(), 0u);
}

TEST(Ply, AsciiWithForeignPropertiesIsRead) {
  const TemporaryFolder folder;
  folder.write(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "element face 1\nproperty list uchar float weights\nproperty list uchar int vertex_index\nend_header\n"
      "9 0 0 0\n9 1 0 0\n9 0 2 0\n2 0.5 0.5 3 0 1 2\n");
  const PlyMesh ply = read_ply(folder / "m.ply");
  ASSERT_EQ(ply.mesh.triangle_count(), 1u);
  EXPECT_DOUBLE_EQ(surface_area(ply.mesh), 1.0);
  EXPECT_TRUE(ply.kind.empty());
}

TEST(Ply, EveryTruncationIsRefusedByName) {
  const TemporaryFolder folder;
  PlyMesh small;
  small.mesh = disc(6);
  write_ply(folder / "m.ply", small);
  const std::string whole = folder.read("m.ply");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    folder.write("cut.ply", whole.substr(0, length));
    EXPECT_NE(refusal(folder / "cut.ply").find("cut.ply: "), std::string::npos) << length;
  }
}

TEST(Ply, WrongContentIsRefusedWithTheElement) {
  const TemporaryFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::pair<std::string, std::string> cases[] = {
      {head + "0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n", "line 12: value 'nan' is not finite"},
      {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "face 0"},
      {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "face 0"},
      {head + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "face 0"},
      {head + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", "'zero' is not a number"},
      {"solid cube\n", "not a .ply file"},
      {"ply\nformat binary_middle_endian 1.0\nend_header\n", "binary_big_endian"},
      {"ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nend_header\n1 2\n",
       "truncated"},
      {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nproperty int source\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1.5\n",
       "source is not a whole number"},
  };
  for (const auto& [text, reason] : cases) {
    folder.write("m.ply", text);
    EXPECT_NE(refusal(folder / "m.ply").find(reason), std::string::npos) << refusal(folder / "m.ply");
  }
  EXPECT_NE(refusal(folder / "none.ply").find("none.ply"), std::string::npos);
}
