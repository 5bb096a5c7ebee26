#include "conchoid/intersect/unfold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/intersect/manifold_part.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

using namespace shapes;

TEST(CommonDirection, MakesTheSmallestProductLargest) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto unit = [&] { return Vec3(Vec3(normal(random), normal(random), normal(random)).normalized()); };
  const auto smallest = [](const std::vector<Vec3>& set, const Vec3& d) {
    double least = 1;
    for (const Vec3& v : set)
      least = std::min(least, v.dot(d));
    return least;
  };
  for (int k = 0; k < 200; ++k) {
    const Vec3 axis = unit();
    std::vector<Vec3> set;
    for (int i = 0; i < 3 + k % 6; ++i) {
      const Vec3 v = unit();
      set.push_back(v.dot(axis) > 0.05 ? v : Vec3((v + 2 * axis).normalized()));
    }
    const Vec3 d = common_direction(set);
    const double found = smallest(set, d);
    EXPECT_GT(found, 0);
    for (int i = 0; i < 300; ++i)  // no other direction is much better
      EXPECT_LT(smallest(set, (d + 0.3 * unit()).normalized()), found + 0.02);
  }
}

TEST(CommonDirection, ThereIsNoneForOppositeVectors) {
  EXPECT_EQ(common_direction({Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()}), Vec3::Zero());
}

TEST(Unfold, SmoothSheetsKeepEveryBit) {
  const TriMesh wavy =
      sheet(-1, 1, -1, 1, 12, 12, [](double u, double v) { return Vec3(u, v, 0.2 * std::sin(5 * u + v)); });
  EXPECT_EQ(unfolded(wavy).positions, wavy.positions);
}

// A loop a few triangles long: it passes through itself, though it turns too little at each node for one to be folded.
TEST(Unfold, SmallCrossingsAreSmoothedNotCutOut) {
  const TriMesh flat = sheet(-1, 1, -1, 1, 12, 12, [](double u, double v) { return Vec3(u, v, 0); });
  int crossed = 0;
  for (const double wide : {0.25, 0.3, 0.4, 0.5})
    for (const double high : {0.2, 0.3, 0.4}) {
      TriMesh looped = flat;
      for (Vec3& x : looped.positions)
        if (std::abs(x.x()) < 0.51) {
          const double phase = std::numbers::pi * x.x() / 0.5, tapered = std::exp(-std::pow(x.y() / 0.3, 4));
          x += tapered * Vec3(-wide * std::sin(phase), 0, high * (1 + std::cos(phase)));
        }
      crossed += embedded_part(unfolded(looped)).triangle_count() < flat.triangle_count() ? 1 : 0;
      const TriMesh part = unfolded_part(looped);
      EXPECT_EQ(part.triangle_count(), flat.triangle_count()) << wide << ' ' << high;
      EXPECT_TRUE(self_intersections(part, 1).empty());
      for (std::size_t n = 0; n < flat.node_count(); ++n)
        if (std::abs(looped.positions[NodeId(n)].y()) > 0.99) {
          EXPECT_EQ(part.positions[NodeId(n)], looped.positions[NodeId(n)]);
        }
    }
  EXPECT_GT(crossed, 2);
}

TEST(Unfold, AFoldedNodeGoesBackBetweenItsNeighbours) {
  for (const bool at_edge : {false, true}) {
    TriMesh flat = sheet(-1, 1, -1, 1, 10, 10, [](double u, double v) { return Vec3(u, v, 0); });
    NodeId folded;
    for (std::size_t n = 0; n < flat.node_count(); ++n)
      if ((flat.positions[NodeId(n)] - (at_edge ? Vec3(1, 0.2, 0) : Vec3(0.2, 0.2, 0))).norm() < 1e-9)
        folded = NodeId(n);
    ASSERT_TRUE(folded.valid());
    const TriMesh before = flat;
    flat.positions[folded] += Vec3(-0.5, 0.1, 0.02);  // beyond the nodes of the next rows
    const TriMesh after = unfolded(flat);
    for (std::size_t t = 0; t < after.triangle_count(); ++t)
      EXPECT_GT(unit_normal(after, TriId(t)).dot(unit_normal(before, TriId(t))), 0.2);
    for (std::size_t n = 0; n < after.node_count(); ++n)
      EXPECT_LT((after.positions[NodeId(n)] - before.positions[NodeId(n)]).norm(), 0.15);
  }
}

}  // namespace
}  // namespace conchoid
