#include "conchoid/crack/closing/last_ligament.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/mesh/winding_number.hpp"
#include "hollow_bodies.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

constexpr double kEdge = 0.1;  // r̄; cells are a fifth of it

/// The unit cube about the origin, as tests break it.
TriMesh unit_cube() {
  TriMesh mesh = box_mesh(Vec3::Constant(1), 4, 4, 4);
  const Vec3 middle = bounding_box(mesh).center();
  for (Vec3& x : mesh.positions)
    x -= middle;
  return mesh;
}

/// Across the cube from x0 to x1, at height z; sticks out in y.
TriMesh plane_sheet(double x0, double x1, double z) {
  return shapes::sheet(x0, x1, -0.6, 0.6, 24, 24, [&](double u, double v) { return Vec3(u, v, z); });
}

TriMesh both(TriMesh a, const TriMesh& b) {
  const std::size_t first = a.node_count();
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& c : b.corners)
    a.corners.push_back(
        {NodeId(c[0].index() + first), NodeId(c[1].index() + first), NodeId(c[2].index() + first)});
  return a;
}

TEST(CellGrid, ItsCellsAreThoseWhoseCentresTheBodyWindsAround) {
  for (const TriMesh& body :
       {shapes::torus(2, 0.7, 16, 8), shapes::cup(12), shapes::block_with_cavity(3, 0.8, 3)}) {
    const CellGrid grid(body, plane_sheet(-0.2, 0.3, 0.1), 0.23);
    std::size_t inside = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
      inside += grid.inside(c) ? 1 : 0;
      ASSERT_EQ(grid.inside(c), winding_number(body, grid.center(c)) > 0.5) << grid.center(c).transpose();
      ASSERT_EQ(grid.number(c), grid.inside(c) ? static_cast<std::int32_t>(inside) - 1 : -1);
    }
    ASSERT_EQ(grid.inside_count(), inside);
    std::size_t pairs = 0, listed = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c)
      for (int axis = 0; axis < 3 && grid.inside(c); ++axis)
        pairs += grid.inside(grid.next(c, axis)) ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const CellPairs& of : grid.pairs(axis))
        for (std::int32_t k = 0; k < of.count; ++k, ++listed) {
          const std::size_t cell = of.cell + static_cast<std::size_t>(k);
          ASSERT_EQ(grid.number(cell), of.number + k);
          ASSERT_EQ(grid.number(grid.next(cell, axis)), of.ahead + k);
        }
    EXPECT_EQ(listed, pairs);
    EXPECT_NEAR(static_cast<double>(inside) * std::pow(grid.size(), 3), enclosed_volume(body),
                0.05 * enclosed_volume(body));
  }
}

// A path of cells around the rim of a sheet, and none through it, wherever the sheet's triangles lie.
TEST(CellGrid, ASheetStandsBetweenExactlyTheCellsItDivides) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 5; ++trial) {
    const Mat3 turn = shapes::random_rotation(random);
    const auto turned = [&](TriMesh mesh) {
      for (Vec3& x : mesh.positions)
        x = turn * x;
      return mesh;
    };
    const TriMesh body = turned(unit_cube()), sheet = turned(plane_sheet(-0.6, 0.2, 0.0137));
    const CellGrid grid(body, sheet, 0.04);
    const Vec3 x = turn.col(0), z = turn.col(2);
    std::size_t walls = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c)
      for (int axis = 0; axis < 3 && grid.inside(c); ++axis) {
        const std::size_t d = grid.next(c, axis);
        if (!grid.inside(d)) continue;
        const double a = grid.center(c).dot(z) - 0.0137, b = grid.center(d).dot(z) - 0.0137;
        const Vec3 at = (grid.center(c) * b - grid.center(d) * a) / (b - a);
        if (std::abs(at.dot(x) - 0.2) < 1e-9) continue;
        const bool between = a * b < 0 && at.dot(x) < 0.2;
        ASSERT_EQ(grid.open(static_cast<std::size_t>(grid.number(c)), axis), !between);
        walls += between ? 1 : 0;
      }
    EXPECT_GT(walls, 100u);
  }
}

TEST(LastLigament, OfACrackThatGoesMostOfTheWayIsTheRestOfItsPlane) {
  const auto found = find_last_ligaments(unit_cube(), plane_sheet(-0.6, 0.38, 0.013), kEdge);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].half_width, 0.06, 0.25 * kEdge / 2);
  EXPECT_NEAR(found[0].smaller_part, 0.487, 0.02);
  for (const Vec3& x : found[0].faces) {
    EXPECT_GT(x.x(), 0.36);
    EXPECT_LT(std::abs(x.z() - 0.013), 0.25 * kEdge);
  }
}

TEST(LastLigament, ThereIsNoneWhereMoreIsLeftThanIsCracked) {
  EXPECT_TRUE(find_last_ligaments(unit_cube(), plane_sheet(-0.6, -0.2, 0.0), kEdge).empty());
  EXPECT_TRUE(find_last_ligaments(unit_cube(), {}, kEdge).empty());
}

// Boundary elements narrower than the body have come apart: so does the body, along as little as can be, though that is
// more than would break by itself.
TEST(LastLigament, OfElementsThatHaveComeApartIsFoundInTheBodyTheyStandFor) {
  const TriMesh sheet = plane_sheet(-0.6, 0.25, 0.013);
  TriMesh elements = box_mesh({0.74, 1, 1}, 4, 4, 4);
  const double low = bounding_box(elements).low.x();
  for (Vec3& x : elements.positions)
    x.x() += -0.5 - low;
  ASSERT_NEAR(bounding_box(elements).high.x(), 0.24, 1e-12);
  EXPECT_TRUE(find_last_ligaments(unit_cube(), sheet, kEdge).empty());
  const auto apart = find_last_ligaments(elements, sheet, kEdge);
  ASSERT_EQ(apart.size(), 1u);
  EXPECT_TRUE(apart[0].faces.empty());
  const auto same = find_same_ligament(unit_cube(), sheet, kEdge, apart[0]);
  ASSERT_TRUE(same);
  EXPECT_NEAR(same->half_width, 0.125, 0.25 * kEdge);
  EXPECT_NEAR(same->smaller_part, 0.487, 0.02);
  for (const Vec3& x : same->faces) {
    EXPECT_GT(x.x(), 0.23);
    EXPECT_LT(std::abs(x.z() - 0.013), 0.25 * kEdge);
  }
  EXPECT_FALSE(find_same_ligament(unit_cube(), {}, kEdge, apart[0]));
}

// Two cracks that have passed each other: what is left runs from one to the other, whichever side is up.
TEST(LastLigament, LiesAcrossTheGapBetweenCracksThatOverlap) {
  const TriMesh left = plane_sheet(-0.6, 0.1, 0.03);
  TriMesh right = plane_sheet(-0.1, 0.6, -0.03);
  for (const bool flipped : {false, true}) {
    if (flipped)
      for (auto& c : right.corners)
        std::swap(c[1], c[2]);
    const auto found = find_last_ligaments(unit_cube(), both(left, right), kEdge);
    ASSERT_EQ(found.size(), 2u);
    for (const LastLigament& l : found) {
      EXPECT_NEAR(l.half_width, 0.03, 0.2 * kEdge / 2);
      EXPECT_NEAR(l.smaller_part, 0.5, 0.06);
    }
  }
}

// A front round a hole, from both sides.
TEST(LastLigament, LiesBetweenTheTwoEndsOfACrackRoundAHole) {
  const TriMesh body = shapes::tube(1, 0.6, 4, 10);
  const TriMesh sheet = shapes::sheet(0.15, 6.13, 0.5, 1.1, 80, 8, [&](double a, double r) {
    return Vec3(r * std::cos(a), r * std::sin(a), 0.021);
  });
  const auto found = find_last_ligaments(body, sheet, 0.2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].half_width, 0.15 * 0.8, 0.05);
  for (const Vec3& x : found[0].faces)
    EXPECT_LT(std::abs(x.z() - 0.021), 0.04);
}

// A sheet that undulates about the body's face, deeper than a cell: a hundred scales of a few cells each, which make
// no part together.
TEST(LastLigament, SpecksOfTheGridAreNone) {
  const auto waves = [](double depth) {
    return shapes::sheet(-0.6, 0.6, -0.6, 0.6, 90, 90, [&](double u, double v) {
      return Vec3(u, v, 0.5 + depth * std::cos(40 * u) * std::cos(40 * v));
    });
  };
  EXPECT_TRUE(find_last_ligaments(unit_cube(), waves(0.03), kEdge).empty());
}

// Islands of a few cells each beside a body, as a grid makes them of what is thin, are not parted from it by a crack that they
// do not touch, whichever side is up.
TEST(LastLigament, IslandsOfTheGridArePartOfWhatIsMost) {
  TriMesh body = unit_cube();
  constexpr int islands = 300;
  for (int i = 0; i < islands; ++i) {
    TriMesh island = box_mesh(Vec3::Constant(0.045), 1, 1, 1);
    for (Vec3& x : island.positions)
      x += Vec3(0.6 + 0.09 * (i / 100), -0.45 + 0.09 * (i % 10), -0.45 + 0.09 * (i / 10 % 10));
    body = both(body, island);
  }
  EXPECT_TRUE(find_last_ligaments(body, plane_sheet(-0.6, -0.2, 0.0), kEdge).empty());
  TriMesh low = plane_sheet(-0.6, 0.38, -0.443);
  for (const bool flipped : {false, true}) {
    if (flipped)
      for (auto& c : low.corners)
        std::swap(c[1], c[2]);
    const auto found = find_last_ligaments(body, low, kEdge);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].smaller_part, 0.057, 0.006);
    EXPECT_FALSE(found[0].faces.empty());
  }
}

TEST(LastLigament, TurnsAndMovesWithTheBody) {
  const auto reference = find_last_ligaments(unit_cube(), plane_sheet(-0.6, 0.38, 0.013), kEdge);
  ASSERT_EQ(reference.size(), 1u);
  std::mt19937 random(5);
  for (int trial = 0; trial < 3; ++trial) {
    const Mat3 turn = shapes::random_rotation(random);
    const auto placed = [&](TriMesh mesh) {
      for (Vec3& x : mesh.positions)
        x = turn * x + Vec3(3, -2, 1);
      return mesh;
    };
    const auto found =
        find_last_ligaments(placed(unit_cube()), placed(plane_sheet(-0.6, 0.38, 0.013)), kEdge);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].half_width, reference[0].half_width, 0.1 * kEdge);
    EXPECT_NEAR(found[0].smaller_part, reference[0].smaller_part,
                1.5 * found[0].grid->size());  // layers of cells
  }
}

TEST(LigamentSurface, LiesInThePlaneOfACrackAndReachesOverItsEndAndOutOfTheBody) {
  const TriMesh sheet = plane_sheet(-0.6, 0.38, 0.013);
  const auto found = find_last_ligaments(unit_cube(), sheet, kEdge);
  ASSERT_EQ(found.size(), 1u);
  const TriMesh surface = ligament_surface(found[0], sheet);
  ASSERT_GT(surface.triangle_count(), 100u);
  const Box box = bounding_box(surface);
  EXPECT_LT(box.low.x(), 0.38 - 2 * kEdge / 5);
  EXPECT_GT(box.high.x(), 0.5);
  EXPECT_LT(box.low.y(), -0.5);
  EXPECT_GT(box.high.y(), 0.5);
  for (const Vec3& x : surface.positions)
    EXPECT_LT(std::abs(x.z() - 0.013), 0.1 * kEdge);
}

}  // namespace
}  // namespace conchoid
