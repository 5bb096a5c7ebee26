#include "conchoid/mesh/longest_edge_bisection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "conchoid/mesh/models.hpp"
#include "mesh_checks.hpp"

namespace conchoid {
namespace {

double longest(const Triangle& t) {
  return std::max({(t[0] - t[1]).norm(), (t[1] - t[2]).norm(), (t[2] - t[0]).norm()});
}

double smallest_angle(const TriMesh& mesh) {
  double least = 4;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const Triangle t = mesh.triangle(TriId(i));
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = t[(k + 1) % 3] - t[k], b = t[(k + 2) % 3] - t[k];
      least = std::min(least, std::atan2(cross(a, b).norm(), a.dot(b)));
    }
  }
  return least;
}

// Too long for its distance from a place on the surface.
auto near_place(const Vec3& place, double finest) {
  return [=](const Triangle& t) {
    return longest(t) > finest + 0.5 * ((t[0] + t[1] + t[2]) / 3 - place).norm();
  };
}

const Vec3 kPlace(0.5, 0.1, 0.2);

TEST(LongestEdgeBisection, DividesWhatIsTooCoarseAndStaysClosed) {
  for (const char* model : {"cube", "cylinder", "bar"}) {
    const TriMesh mesh = built_in_model(model).mesh;
    const auto too_coarse = near_place(mesh.positions[NodeId(3)], 0.01 * bounding_box(mesh).diagonal());
    const DividedMesh divided = bisect_longest_edges(mesh, too_coarse);
    ASSERT_GT(divided.mesh.triangle_count(), mesh.triangle_count());
    for (std::size_t i = 0; i < mesh.node_count(); ++i)
      EXPECT_EQ(divided.mesh.positions[NodeId(i)], mesh.positions[NodeId(i)]);
    std::vector<double> area(mesh.triangle_count(), 0);
    for (std::size_t t = 0; t < divided.mesh.triangle_count(); ++t) {
      EXPECT_FALSE(too_coarse(divided.mesh.triangle(TriId(t))));
      area[divided.parent[t].index()] += area_vector(divided.mesh, TriId(t)).norm();
      EXPECT_GT(unit_normal(divided.mesh, TriId(t)).dot(unit_normal(mesh, divided.parent[t])), 1 - 1e-12);
    }
    for (std::size_t t = 0; t < area.size(); ++t)
      EXPECT_NEAR(area[t], area_vector(mesh, TriId(t)).norm(), 1e-12 * area[t]);
    for (const auto& around : triangle_neighbours(divided.mesh))
      EXPECT_TRUE(std::all_of(around.begin(), around.end(), [](TriId t) { return t.valid(); }));
    EXPECT_GE(smallest_angle(divided.mesh), 0.5 * smallest_angle(mesh) - 1e-12);
  }
}

TEST(LongestEdgeBisection, AMirroredMeshIsDividedTheSameWay) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 3, 3, 3);
  TriMesh mirrored = mesh;
  for (Vec3& x : mirrored.positions)
    x.x() = -x.x();
  for (auto& c : mirrored.corners)
    std::swap(c[1], c[2]);
  TriMesh back = bisect_longest_edges(mirrored, near_place(kPlace.cwiseProduct(Vec3(-1, 1, 1)), 0.05)).mesh;
  for (Vec3& x : back.positions)
    x.x() = -x.x();
  for (auto& c : back.corners)
    std::swap(c[1], c[2]);
  EXPECT_EQ(triangle_soup(back), triangle_soup(bisect_longest_edges(mesh, near_place(kPlace, 0.05)).mesh));
}

// As where a crack grows: what was divided stays so.
TEST(LongestEdgeBisection, MoreThatIsTooCoarseOnlyDividesFurther) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 3, 3, 3);
  const auto first = near_place(kPlace, 0.05), second = near_place({0.5, -0.3, 0.1}, 0.05);
  const auto nodes = [](const TriMesh& m) {
    std::set<std::array<double, 3>> out;
    for (const Vec3& x : m.positions)
      out.insert({x.x(), x.y(), x.z()});
    return out;
  };
  const auto few = nodes(bisect_longest_edges(mesh, first).mesh);
  const auto many =
      nodes(bisect_longest_edges(mesh, [&](const Triangle& t) { return first(t) || second(t); }).mesh);
  EXPECT_GT(many.size(), few.size());
  EXPECT_TRUE(std::includes(many.begin(), many.end(), few.begin(), few.end()));
}

// The halves are the history of the division: each lies where it says in its triangle of the first mesh, and around the
// middle of every edge that was divided there are four.
TEST(LongestEdgeBisection, HalvesTellHowEveryTriangleWasMade) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 3, 3, 3);
  const DividedMesh divided = bisect_longest_edges(mesh, near_place(kPlace, 0.05));
  ASSERT_EQ(divided.half.size(), divided.mesh.triangle_count());
  std::vector<int> around(divided.mesh.node_count(), 0);
  for (const HalfTriangle& half : divided.halves)
    ++around[half.corners[2].index()];
  for (std::size_t i = 0; i < around.size(); ++i)
    EXPECT_EQ(around[i], i < mesh.node_count() ? 0 : 4);
  for (std::size_t t = 0; t < divided.half.size(); ++t) {
    if (divided.half[t] == kNoHalf) {
      EXPECT_EQ(divided.mesh.corners[TriId(t)], mesh.corners[divided.parent[t]]);
      continue;
    }
    EXPECT_EQ(divided.halves[divided.half[t]].corners, divided.mesh.corners[TriId(t)]);
    const Triangle parent = mesh.triangle(divided.parent[t]);
    for (std::size_t h = divided.half[t]; h != kNoHalf; h = divided.halves[h].whole) {
      const HalfTriangle& half = divided.halves[h];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& l = half.in_parent[k];
        EXPECT_EQ(l.sum(), 1);
        EXPECT_LT(
            (l[0] * parent[0] + l[1] * parent[1] + l[2] * parent[2] - divided.mesh.positions[half.corners[k]])
                .norm(),
            1e-15);
      }
      EXPECT_TRUE(half.whole == kNoHalf || half.whole < h);
    }
  }
}

TEST(LongestEdgeBisection, WhatIsFineStaysAsItIs) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 3, 3, 3);
  const DividedMesh same = bisect_longest_edges(mesh, [](const Triangle&) { return false; });
  EXPECT_EQ(same.mesh.corners, mesh.corners);
  EXPECT_EQ(same.parent.size(), mesh.triangle_count());
  EXPECT_TRUE(same.halves.empty());
}

}  // namespace
}  // namespace conchoid
