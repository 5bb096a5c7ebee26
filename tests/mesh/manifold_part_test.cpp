#include "conchoid/mesh/manifold_part.hpp"

#include <gtest/gtest.h>

using namespace conchoid;

namespace {

TriMesh two_triangles() {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 1)};
  mesh.corners = {{NodeId(0), NodeId(1), NodeId(2)}, {NodeId(0), NodeId(2), NodeId(3)}};
  return mesh;
}

}  // namespace

TEST(ManifoldPart, ProperSheetComesBackUnchanged) {
  const TriMesh sheet = two_triangles();
  EXPECT_EQ(manifold_part(sheet).corners, sheet.corners);
}

TEST(ManifoldPart, ThirdTriangleOnAnEdgeIsLeftOut) {
  TriMesh sheet = two_triangles();
  sheet.corners.push_back({NodeId(0), NodeId(2), NodeId(4)});
  const TriMesh part = manifold_part(sheet);
  EXPECT_EQ(part.corners, two_triangles().corners);
  EXPECT_EQ(part.node_count(), sheet.node_count());
}
