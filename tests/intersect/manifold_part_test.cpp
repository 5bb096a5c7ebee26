#include "conchoid/intersect/manifold_part.hpp"

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

TEST(EmbeddedPart, ProperSheetComesBackUnchanged) {
  EXPECT_EQ(embedded_part(two_triangles()).corners, two_triangles().corners);
}

TEST(EmbeddedPart, WhatRunsThroughAnEarlierTriangleIsLeftOut) {
  TriMesh sheet = two_triangles();
  const NodeId a = sheet.positions.add(Vec3(0.6, 0.3, -1)), b = sheet.positions.add(Vec3(0.7, 0.3, 1)),
               c = sheet.positions.add(Vec3(0.8, 0.4, 1)), d = sheet.positions.add(Vec3(0.9, 0.5, 2));
  sheet.corners.push_back({a, b, c});  // through triangle 0
  sheet.corners.push_back({c, b, d});  // its neighbour, above
  const NodeId e = sheet.positions.add(Vec3(0.6, 0.35, 0.5)), f = sheet.positions.add(Vec3(0.9, 0.3, 0.6)),
               g = sheet.positions.add(Vec3(0.9, 0.4, 0.7));
  sheet.corners.push_back({e, f, g});  // would only meet the one left out
  const TriMesh part = embedded_part(sheet);
  ASSERT_EQ(part.triangle_count(), 4u);
  EXPECT_EQ(part.corners[TriId(2)], sheet.corners[TriId(3)]);
  EXPECT_EQ(part.corners[TriId(3)], sheet.corners[TriId(4)]);
  EXPECT_EQ(part.node_count(), sheet.node_count());
}
