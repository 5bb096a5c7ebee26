#include "conchoid/io/ply.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_ply(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(Ply, AllPropertiesComeBackBitForBit) {
  const ScratchFolder folder;
  PlyMesh ply;
  ply.mesh = sheet(3, 1.0 / 3.0);
  for (std::size_t t = 0; t < ply.mesh.triangle_count(); ++t) {
    ply.face_kind.push_back(t % 2 ? FaceKind::fracture : FaceKind::original);
    ply.source.push_back(t == 5 ? TriId() : TriId(t * 7));
    ply.frame.push_back(static_cast<int>(t) / 4);
  }
  write_ply(folder / "m.ply", ply);
  const PlyMesh back = read_ply(folder / "m.ply");
  EXPECT_EQ(back.mesh.positions, ply.mesh.positions);
  EXPECT_EQ(back.mesh.corners, ply.mesh.corners);
  EXPECT_EQ(back.face_kind, ply.face_kind);
  EXPECT_EQ(back.source, ply.source);
  EXPECT_EQ(back.frame, ply.frame);
}

TEST(Ply, AnEmptyCrackIsAMesh) {
  const ScratchFolder folder;
  write_ply(folder / "m.ply", {});
  EXPECT_EQ(read_ply(folder / "m.ply").mesh.triangle_count(), 0u);
}

TEST(Ply, AsciiWithForeignPropertiesIsRead) {
  const ScratchFolder folder;
  write_text(
      folder / "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "element face 1\nproperty list uchar float weights\nproperty list uchar int vertex_index\nend_header\n"
      "9 0 0 0\n9 1 0 0\n9 0 2 0\n2 0.5 0.5 3 0 1 2\n");
  const PlyMesh ply = read_ply(folder / "m.ply");
  ASSERT_EQ(ply.mesh.triangle_count(), 1u);
  EXPECT_DOUBLE_EQ(surface_area(ply.mesh), 1.0);
  EXPECT_TRUE(ply.face_kind.empty());
}

TEST(Ply, EveryTruncationIsRefusedByName) {
  const ScratchFolder folder;
  write_ply(folder / "m.ply", {sheet(1, 0), {}, {}, {}});
  const std::string whole = file_content(folder / "m.ply");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_text(folder / "cut.ply", whole.substr(0, length));
    EXPECT_NE(refusal(folder / "cut.ply").find("cut.ply: "), std::string::npos) << length;
  }
}

TEST(Ply, WrongContentIsRefusedWithTheElement) {
  const ScratchFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::pair<std::string, std::string> cases[] = {
      {head + "0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n", "vertex 2"},
      {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "face 0"},
      {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "face 0"},
      {head + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 0\n", "not a triangle"},
      {head + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", "not part of a number"},
      {"solid cube\n", "not a PLY"},
      {"ply\nformat binary_big_endian 1.0\nend_header\n", "binary_big_endian"},
      {"ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nend_header\n1 2\n",
       "truncated"},
  };
  for (const auto& [text, reason] : cases) {
    write_text(folder / "m.ply", text);
    EXPECT_NE(refusal(folder / "m.ply").find(reason), std::string::npos) << refusal(folder / "m.ply");
  }
  EXPECT_NE(refusal(folder / "none.ply").find("none.ply"), std::string::npos);
}
