#include "conchoid/mesh/surface_attributes.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

AttributedMesh read_text(const std::string& ending, const std::string& text) {
  const test::TemporaryFolder folder;
  return read_surface(folder.write("surface" + ending, text));
}

// A square pyramid: the base is a polygon of its own material, two sides share an edge that is a seam.
const std::string pyramid_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.25\n"
    "vn 0 0 -2\nvn 0 -1 0\n"
    "usemtl stone\nf 1/1/1 4/4/1 3/3/1 2/2/1\n"
    "usemtl moss\nf 1/1/2 2/2/2 5/5/2\nf 2/-2/ 3/2 5/3//\n"
    "usemtl stone\nf 3 4 5\nf 4//9 1//9 5//9\n";

TEST(SurfaceAttributes, ObjSeamsKeepBothSides) {
  const auto [mesh, a] = read_text(".obj", pyramid_obj);
  ASSERT_EQ(mesh.triangle_count(), 6u);
  EXPECT_EQ(mesh.node_count(), 5u);
  EXPECT_EQ(a.materials, (std::vector<std::string>{"stone", "moss"}));
  EXPECT_EQ(a.material, (std::vector<int>{0, 0, 1, 1, 0, 0}));
  ASSERT_EQ(a.uv.size(), 6u);
  // the second triangle of the polygon's fan: corners 1, 3, 2 of the file
  EXPECT_EQ(mesh.corners[TriId(1)], (std::array{NodeId(0), NodeId(2), NodeId(1)}));
  EXPECT_EQ(a.uv[1][1], Vec2(1, 1));
  // node 2 (index 1) has different texture coordinates on the two sides of the seam
  EXPECT_EQ(a.uv[2][1], Vec2(1, 0));
  EXPECT_EQ(a.uv[3][0], Vec2(0, 1));
  EXPECT_EQ(a.uv[2][2], Vec2(0.25, 0));  // v was left out
  EXPECT_EQ(a.normal[0][0], Vec3(0, 0, -1));
  EXPECT_EQ(a.normal[2][0], Vec3(0, -1, 0));
  for (const std::size_t without : {3, 4, 5})
    EXPECT_EQ(a.normal[without][0], Vec3::Zero());
}

TEST(SurfaceAttributes, ObjWithoutAnyHasNone) {
  EXPECT_TRUE(read_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").attributes.empty());
}

TEST(SurfaceAttributes, ObjFacesBeforeTheFirstMaterialGetOneOfTheirOwn) {
  const auto a = read_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a\nf 3 2 1\n").attributes;
  EXPECT_EQ(a.materials, (std::vector<std::string>{"a", "default"}));
  EXPECT_EQ(a.material, (std::vector<int>{1, 0}));
}

const std::string ply_vertices =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
    "element face 2\n";
const std::string ply_points = "0 0 0 0 0 3 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 1 0 1\n";

TEST(SurfaceAttributes, PlyVerticesGiveTheirsToCorners) {
  const auto a = read_text(".ply", ply_vertices +
                                       "property list uchar int vertex_indices\nproperty int material_index\n"
                                       "end_header\n" +
                                       ply_points + "3 0 1 2 7\n3 0 2 3 4\n")
                     .attributes;
  EXPECT_EQ(a.materials, (std::vector<std::string>{"material_7", "material_4"}));
  EXPECT_EQ(a.material, (std::vector<int>{0, 1}));
  EXPECT_EQ(a.normal[0][0], Vec3(0, 0, 1));
  EXPECT_EQ(a.uv[1][1], Vec2(1, 1));
}

TEST(SurfaceAttributes, PlyFacesWithTextureCoordinatesOfTheirOwnComeFirst) {
  const auto a =
      read_text(".ply", ply_vertices +
                            "property list uchar float texcoord\n"
                            "property list uchar int vertex_indices\nend_header\n" +
                            ply_points + "8 .5 .5 .25 .5 .75 .5 0 1 4 0 1 2 3\n6 0 0 0 0 0 0 3 3 2 1\n")
          .attributes;
  ASSERT_EQ(a.uv.size(), 3u);  // the square is two triangles
  EXPECT_EQ(a.uv[1][0], Vec2(0.5, 0.5));
  EXPECT_EQ(a.uv[1][1], Vec2(0.75, 0.5));
  EXPECT_EQ(a.uv[1][2], Vec2(0, 1));
  EXPECT_EQ(a.uv[2][0], Vec2(0, 0));
}

TEST(SurfaceAttributes, PlyFacesWithNormalsOfTheirOwnComeFirst) {
  const std::string head = ply_vertices +
                           "property list uchar int vertex_indices\n"
                           "property list uchar float normals\nend_header\n" +
                           ply_points;
  const auto a =
      read_text(".ply", head + "4 0 1 2 3 12 1 0 0 0 2 0 0 0 4 0 -1 0\n3 3 2 1 4 1 0 0 1\n").attributes;
  ASSERT_EQ(a.normal.size(), 3u);  // the square is two triangles
  EXPECT_EQ(a.normal[1][0], Vec3(1, 0, 0));
  EXPECT_EQ(a.normal[1][1], Vec3(0, 0, 1));
  EXPECT_EQ(a.normal[1][2], Vec3(0, -1, 0));
  EXPECT_EQ(a.normal[2][0], Vec3::Zero());  // four numbers are not normals of three corners
  EXPECT_EQ(a.uv[1][1], Vec2(1, 1));
  EXPECT_THROW(read_text(".ply", head + "3 0 1 2 9 1 0 0 1 0 nan 1 0 0\n3 0 2 3 0\n"), InputError);
}

TEST(SurfaceAttributes, WeightsFindThePlaceInTheTriangle) {
  const Triangle t{Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.4, -0.3), Vec3(0.6, 1.7, 0.9)};
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(barycentric_weights(t, t[static_cast<std::size_t>(k)]), Vec3(Vec3::Unit(k)));
  const Vec3 w(0.2, 0.3, 0.5);
  EXPECT_NEAR((barycentric_weights(t, w[0] * t[0] + w[1] * t[1] + w[2] * t[2]) - w).norm(), 0, 1e-15);
  EXPECT_NEAR((barycentric_weights(t, 0.25 * t[0] + 0.75 * t[2]) - Vec3(0.25, 0, 0.75)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace conchoid
