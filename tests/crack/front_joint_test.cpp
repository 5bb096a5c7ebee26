#include "conchoid/crack/closing/front_joint.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "crack_samples.hpp"
#include "growth.hpp"

// Fronts that meet become one.
using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// Every edge is walked once each way or lies on the boundary. @return number of boundary edges
std::size_t boundary_edges(const TriMesh& mesh) {
  std::map<std::pair<NodeId, NodeId>, int> walked;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto& c = mesh.corners[TriId(t)];
    EXPECT_GT(area_vector(mesh, TriId(t)).norm(), 0);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(++walked[std::pair(c[k], c[(k + 1) % 3])], 1);
  }
  return static_cast<std::size_t>(std::count_if(walked.begin(), walked.end(), [&](const auto& edge) {
    return !walked.contains({edge.first.second, edge.first.first});
  }));
}

std::size_t front_nodes(const CrackSheet& sheet) {
  std::size_t count = 0;
  for (const SheetFront& front : sheet.fronts)
    count += front.nodes.size();
  return count;
}

std::size_t marker_count(const FineFront& fine) {
  std::size_t count = 0;
  for (const MarkerCurve& curve : fine.curves())
    count += curve.size();
  return count;
}

/// No hole, no fold: what is open are the fronts, and all triangles look up.
void expect_sound(const Growth& growth) {
  EXPECT_EQ(boundary_edges(growth.sheet.mesh), front_nodes(growth.sheet));
  EXPECT_EQ(boundary_edges(growth.fine.surface()), marker_count(growth.fine));
  if (growth.follower) {
    EXPECT_EQ(boundary_edges(growth.follower->surface()), marker_count(*growth.follower));
  }
  for (const TriMesh* mesh : {&growth.sheet.mesh, &growth.fine.surface()})
    for (std::size_t t = 0; t < mesh->triangle_count(); ++t)
      EXPECT_GT(area_vector(*mesh, TriId(t)).z(), 0);
}

TriMesh disc_at(double radius, int rings, const Vec3& center) {
  return transformed(disc(radius, rings), Mat3::Identity(), center);
}

/// Area of two discs of equal radius.
double united_area(double radius, double distance) {
  const double half = std::min(1.0, distance / 2 / radius);
  const double lens = 2 * radius * radius * std::acos(half) - distance * radius * std::sqrt(1 - half * half);
  return 2 * std::numbers::pi * radius * radius - lens;
}

}  // namespace

TEST(FrontJoint, TwoDiscsInOnePlaneBecomeOneCrack) {
  for (const double shift : {0.0, 0.31}) {
    Growth growth({disc_at(0.6, 3, {-0.9, 0, 0}), disc_at(0.6, 3, {0.9, shift, 0})}, kSpacing / 2);
    double radius = 0.6;
    for (int frame = 0; frame < 9; ++frame) {
      SCOPED_TRACE(::testing::Message() << "shift " << shift << " frame " << frame);
      growth.straight_frame(0.6);
      radius += 0.6 * kEdge;
      expect_sound(growth);
    }
    ASSERT_EQ(growth.sheet.fronts.size(), 1u);
    ASSERT_EQ(growth.fine.curves().size(), 1u);
    const double exact = united_area(radius, std::hypot(1.8, shift));
    EXPECT_NEAR(surface_area(growth.sheet.mesh) / exact, 1, 0.04);
    EXPECT_NEAR(surface_area(growth.fine.surface()) / exact, 1, 0.04);
    EXPECT_NEAR(surface_area(growth.follower->surface()) / surface_area(growth.fine.surface()), 1, 0.005);
    const auto& front = growth.sheet.fronts[0];
    for (const NodeId n : front.nodes)
      EXPECT_EQ(growth.sheet.state[n], FrontState::active);
    std::map<NodeId, Vec3> attached;
    for (const Marker& m : growth.fine.curves()[0].markers)
      if (m.coarse.valid()) attached.emplace(m.coarse, m.position);
    for (const NodeId n : front.nodes)
      EXPECT_LT((attached.at(n) - growth.sheet.mesh.positions[n]).norm(), 1e-12);
  }
}

// Faces that open against each other cannot be one sheet: both stop.
TEST(FrontJoint, CracksOfOppositeOrientationStopBeforeEachOther) {
  TriMesh turned = disc_at(0.6, 3, {0.9, 0, 0});
  for (auto& c : turned.corners)
    std::swap(c[1], c[2]);
  Growth growth({disc_at(0.6, 3, {-0.9, 0, 0}), turned});
  for (int frame = 0; frame < 5; ++frame)
    growth.straight_frame(0.6);
  EXPECT_EQ(growth.sheet.fronts.size(), 2u);
  EXPECT_EQ(boundary_edges(growth.sheet.mesh), front_nodes(growth.sheet));
  std::size_t arrested = 0;
  for (const SheetFront& front : growth.sheet.fronts)
    for (const NodeId n : front.nodes)
      arrested += growth.sheet.state[n] == FrontState::arrested ? 1 : 0;
  EXPECT_GT(arrested, 4u);
}

TEST(OrientedLike, TurnsAPartToTheSideOfTheOneNextToIt) {
  CrackSheet sheet;
  append_part(sheet, disc(0.6, 3));
  TriMesh turned = disc_at(0.6, 3, {1.8, 0, 0});
  EXPECT_EQ(oriented_like(sheet, turned).corners, turned.corners);
  for (auto& c : turned.corners)
    std::swap(c[1], c[2]);
  EXPECT_GT(unit_normal(oriented_like(sheet, turned), TriId(0)).z(), 0.99);
  EXPECT_EQ(oriented_like(CrackSheet(), turned).corners, turned.corners);
}

// A slot across a plate closes from both sides and from its ends.
TEST(FrontJoint, ASlotCloses) {
  TriMesh plate = rectangle(3, 2, 15, 10);
  IdVector<TriId, std::array<NodeId, 3>> kept;
  for (std::size_t t = 0; t < plate.triangle_count(); ++t) {
    const Vec3 x = centroid(plate, TriId(t)) - Vec3(1.5, 1, 0);
    if (std::abs(x.x()) > 0.6 || std::abs(x.y()) > 0.2) kept.push_back(plate.corners[TriId(t)]);
  }
  plate.corners = kept;
  Growth growth({plate});
  ASSERT_EQ(growth.sheet.fronts.size(), 2u);
  const double full = 3 * 2;
  for (const SheetFront& front : growth.sheet.fronts)
    for (const NodeId n : front.nodes) {
      const Vec3& x = growth.sheet.mesh.positions[n];
      if (x.x() < 0.1 || x.x() > 2.9 || x.y() < 0.1 || x.y() > 1.9)
        growth.sheet.state[n] = FrontState::arrested;
    }
  for (int frame = 0; frame < 8 && growth.sheet.fronts.size() > 1; ++frame)
    growth.straight_frame(0.5);
  ASSERT_EQ(growth.sheet.fronts.size(), 1u);
  EXPECT_EQ(boundary_edges(growth.sheet.mesh), front_nodes(growth.sheet));
  EXPECT_EQ(boundary_edges(growth.fine.surface()), marker_count(growth.fine));
  EXPECT_NEAR(surface_area(growth.sheet.mesh), full, 1e-9);
  EXPECT_NEAR(surface_area(growth.fine.surface()), full,
              1e-3 * full);  // markers overlap a little in its corners
}

// Part of a ring about the z axis, from angle `half_gap` round to −half_gap; rows kEdge apart.
TriMesh open_ring(double inner, int rows, int around, double half_gap) {
  TriMesh mesh;
  for (int j = 0; j <= around; ++j)
    for (int k = 0; k <= rows; ++k) {
      const double phi = half_gap + (2 * std::numbers::pi - 2 * half_gap) * j / around;
      mesh.positions.push_back((inner + k * kEdge) * Vec3(std::cos(phi), std::sin(phi), 0));
    }
  const auto node = [&](int j, int k) { return NodeId(j * (rows + 1) + k); };
  for (int j = 0; j < around; ++j)
    for (int k = 0; k < rows; ++k) {
      mesh.corners.push_back({node(j, k), node(j, k + 1), node(j + 1, k + 1)});
      mesh.corners.push_back({node(j, k), node(j + 1, k + 1), node(j + 1, k)});
    }
  return mesh;
}

bool crosses(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto side = [](const Vec3& p, const Vec3& q, const Vec3& x) { return (q - p).cross(x - p).z(); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// Edges of the fronts that cross each other, in a sheet in the plane z = 0.
int crossings(const CrackSheet& sheet) {
  std::vector<std::pair<NodeId, NodeId>> edges;
  for (const SheetFront& front : sheet.fronts)
    for (std::size_t i = 0; i < edge_count(front.nodes.size(), front.closed); ++i)
      edges.emplace_back(front.nodes[i], front.nodes[next_index(i, front.nodes.size(), front.closed)]);
  const auto& x = sheet.mesh.positions;
  int count = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      if (a != c && a != d && b != c && b != d) count += crosses(x[a], x[b], x[c], x[d]) ? 1 : 0;
    }
  return count;
}

// A crack that has come round a hole in a thick wall: its sheet sticks out into the hole, where its two ends come near
// each other first.
TEST(FrontJoint, EndsThatComeRoundAHoleDoNotPassEachOtherInIt) {
  constexpr double hole = 2 * kEdge, wall = 7 * kEdge;
  for (const double half_gap : {0.7, 0.8, 0.9, 1.0, 1.1, 1.2})
    for (const double share : {0.5, 0.7, 0.9}) {
      Growth growth(open_ring(hole - 0.4 * kEdge, 6, 24, half_gap));
      CrackSheet& sheet = growth.sheet;
      for (int frame = 0; frame < 8; ++frame) {
        for (const SheetFront& front : sheet.fronts)
          for (const NodeId n : front.nodes) {
            const double r = sheet.mesh.positions[n].norm();
            if (sheet.state[n] != FrontState::arrested)
              sheet.state[n] = r < hole || r > wall ? FrontState::outside : FrontState::active;
          }
        growth.advance(with_drawn_nodes(
            sheet, steps_of(
                       sheet, [](NodeId) { return 0.0; }, [=](NodeId) { return intensity_for(share); })));
        ASSERT_EQ(crossings(sheet), 0)
            << "half a gap " << half_gap << ", share " << share << ", frame " << frame;
      }
    }
}

TEST(Relinked, ChainsAreCutAndTied) {
  // two rings of four, joined across 1–2 and 11–12
  const std::vector<FrontChain> rings{{{0, 1, 2, 3}, true}, {{10, 11, 12, 13}, true}};
  const auto one = relinked(rings, {}, {{1, 12}, {11, 2}});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].closed);
  EXPECT_EQ(one[0].nodes, (std::vector<std::size_t>{0, 1, 12, 13, 10, 11, 2, 3}));
  // one ring of eight pinched in the middle: two rings
  const auto two = relinked({{{0, 1, 2, 3, 4, 5, 6, 7}, true}}, {}, {{2, 7}, {6, 3}});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].nodes, (std::vector<std::size_t>{0, 1, 2, 7}));
  EXPECT_EQ(two[1].nodes, (std::vector<std::size_t>{3, 4, 5, 6}));
  // the corner of an open front is taken out
  const auto open = relinked({{{4, 5, 6, 7}, false}}, {6}, {{5, 7}});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_FALSE(open[0].closed);
  EXPECT_EQ(open[0].nodes, (std::vector<std::size_t>{4, 5, 7}));
}
