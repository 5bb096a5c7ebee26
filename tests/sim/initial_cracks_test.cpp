#include "conchoid/sim/initial_cracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/crack_state.hpp"

// Cracks whose outline or nodes lie exactly in the faces of the body.
namespace conchoid {
namespace {

constexpr double kEdge = 0.05;

struct Pieces {
  double area = 0, worst = 1;  ///< of the sheet inside; smallest altitude over longest edge
};

Pieces cut(const TriMesh& sheet) {
  const TriMesh body = built_in_model("cube").mesh;
  const CutComplex cut = corefine(body, sheet_in_body(sheet, body, "test"), {kMouthMerge, kMouthBend});
  Pieces out;
  const auto look_at = [&](const std::array<NodeId, 3>& c) {
    const Vec3 &a = cut.positions[c[0]], &b = cut.positions[c[1]], &d = cut.positions[c[2]];
    const double longest = std::max({(a - b).squaredNorm(), (b - d).squaredNorm(), (d - a).squaredNorm()});
    out.worst = std::min(out.worst, area_vector2(a, b, d).norm() / longest);
  };
  for (const auto& c : cut.surface)
    look_at(c);
  for (const auto& c : cut.sheet) {
    look_at(c);
    out.area += 0.5 * area_vector2(cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]).norm();
  }
  return out;
}

// A disc about a point of an edge of the cube: a row of its nodes in each of two faces.
TEST(FlushCracks, AQuarterDiscAtAnEdgeLeavesNoSlivers) {
  for (double height : {0.0, 0.013}) {
    const Pieces pieces =
        cut(disc_crack({0.5, 0.5, height}, Vec3::UnitZ(), 0.25, {.edge = kEdge}, Vec3::UnitX()));
    EXPECT_GT(pieces.worst, 5e-3) << height;
    EXPECT_NEAR(pieces.area / (std::numbers::pi * 0.25 * 0.25 / 4), 1, 0.03) << height;
  }
}

TEST(FlushCracks, AHalfDiscInAFaceLeavesNoSlivers) {
  const Pieces pieces = cut(disc_crack({0.5, 0, 0.013}, Vec3::UnitZ(), 0.25, {.edge = kEdge}, Vec3::UnitX()));
  EXPECT_GT(pieces.worst, 5e-3);
  EXPECT_NEAR(pieces.area / (std::numbers::pi * 0.25 * 0.25 / 2), 1, 0.02);
}

// Through the cube from face to face, its outline in both.
TEST(FlushCracks, AStripFromFaceToFaceKeepsItsArea) {
  const Pieces pieces = cut(rectangle_crack({0, 0, 0.013}, {0.4, 0, 0}, {0, 1, 0}, {.edge = kEdge}));
  EXPECT_NEAR(pieces.area / 0.4, 1, 1e-3);
}

}  // namespace
}  // namespace conchoid
