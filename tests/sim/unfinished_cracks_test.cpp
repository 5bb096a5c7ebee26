#include "conchoid/sim/unfinished_cracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

constexpr double kEdge = 0.1;  // of the crack

// Two cubes, the second beyond an edge of the first and so far from it, as the surface of one piece.
TriMesh two_cubes(double apart) {
  TriMesh first = shapes::cube(2), second = first;
  for (Vec3& x : second.positions)
    x += Vec3(1 + apart, 1 + apart, 0);
  return join({first, second});
}

// Nodes at the same place made one.
TriMesh welded(const TriMesh& mesh) {
  TriMesh out;
  for (std::array<NodeId, 3> corners : mesh.corners) {
    for (NodeId& n : corners) {
      const Vec3& x = mesh.positions[n];
      const auto same = std::find(out.positions.begin(), out.positions.end(), x);
      n = same == out.positions.end() ? out.positions.add(x)
                                      : NodeId(static_cast<std::size_t>(same - out.positions.begin()));
    }
    out.corners.push_back(corners);
  }
  return out;
}

GoingOn in_piece(const TriMesh& solid) {
  Fragment piece;
  piece.mesh = piece.unfinished.solid = solid;
  piece.face_kind.assign(solid.triangle_count(), FaceKind::original);
  for (std::size_t t = 0; t < solid.triangle_count(); ++t)
    piece.unfinished.solid_face.emplace_back(t);
  CrackSheet sheet;  // ends in both cubes, across the edge between them
  append_part(sheet, rectangle_crack({0.5, 0.5, 0.13}, {0.9, 0, 0}, {0, 0.9, 0}, {.edge = kEdge}));
  return unfinished_cracks(sheet, piece, kEdge);
}

TEST(UnfinishedCracks, GoOnInEachOfTwoCubes) {
  const GoingOn going_on = in_piece(two_cubes(0.2));
  EXPECT_EQ(going_on.unclear, 0);
  ASSERT_EQ(going_on.sheets.size(), 2u);
  for (const TriMesh& sheet : going_on.sheets)
    EXPECT_GT(surface_area(sheet), 0.05);
}

// A run ended without results where closing a slit had left a piece that hangs together by an edge.
TEST(UnfinishedCracks, AreLeftOutWhereThePieceTouchesItselfAlongAnEdge) {
  const TriMesh hinged = welded(two_cubes(0));
  ASSERT_LT(hinged.node_count(), two_cubes(0).node_count());
  const GoingOn going_on = in_piece(hinged);
  EXPECT_EQ(going_on.unclear, 1);
  EXPECT_TRUE(going_on.sheets.empty());
}

}  // namespace
}  // namespace conchoid
