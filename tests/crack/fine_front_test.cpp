#include "conchoid/crack/fine/fine_front.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "crack_samples.hpp"
#include "growth.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// Every edge is walked at most once each way, and what is open are the given fronts; no triangle is flat or
/// turned against its neighbour by more than `fold` [rad].
void expect_manifold(const TriMesh& mesh, double fold, std::size_t boundary_edges) {
  std::map<std::pair<NodeId, NodeId>, TriId> walked;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto& c = mesh.corners[TriId(t)];
    EXPECT_GT(area_vector(mesh, TriId(t)).norm(), 0);
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(walked.insert({{c[k], c[(k + 1) % 3]}, TriId(t)}).second);
  }
  std::size_t open = 0;
  double steepest = 0;
  for (const auto& [edge, t] : walked) {
    const auto other = walked.find({edge.second, edge.first});
    if (other == walked.end()) {
      ++open;
      continue;
    }
    const double c = unit_normal(mesh, t).dot(unit_normal(mesh, other->second));
    steepest = std::max(steepest, std::acos(std::clamp(c, -1.0, 1.0)));
  }
  EXPECT_EQ(open, boundary_edges);
  EXPECT_LT(steepest, fold);
}

std::size_t marker_count(const FineFront& fine) {
  std::size_t count = 0;
  for (const MarkerCurve& curve : fine.curves())
    count += curve.size();
  return count;
}

/// Every coarse front node lies exactly on the marker it is attached to.
void expect_agreement(const Growth& growth) {
  ASSERT_EQ(growth.fine.curves().size(), growth.sheet.fronts.size());
  for (std::size_t f = 0; f < growth.sheet.fronts.size(); ++f) {
    std::map<NodeId, Vec3> markers;
    for (const Marker& m : growth.fine.curves()[f].markers)
      if (m.coarse.valid()) markers.emplace(m.coarse, m.position);
    for (NodeId node : growth.sheet.fronts[f].nodes) {
      ASSERT_TRUE(markers.contains(node));
      EXPECT_LT((markers.at(node) - growth.sheet.mesh.positions[node]).norm(), 1e-12);
    }
  }
}

}  // namespace

TEST(FineFront, TheInitialSheetIsTheSameSurface) {
  const Growth growth(disc(1, 5));
  EXPECT_NEAR(surface_area(growth.fine.surface()), surface_area(growth.sheet.mesh), 1e-12);
  expect_manifold(growth.fine.surface(), 1e-6, marker_count(growth.fine));
  expect_agreement(growth);
}

TEST(FineFront, AUniformlyGrowingDiscStaysAFlatDisc) {
  Growth growth(disc(1, 5));
  double radius = 1;
  for (int frame = 0; frame < 8; ++frame) {
    growth.straight_frame(0.6);
    radius += 0.6 * kEdge;
    expect_agreement(growth);
    for (const Marker& m : growth.fine.curves()[0].markers)
      EXPECT_NEAR(m.position.norm(), radius, 0.012);
  }
  growth.fine.finish();
  const TriMesh& fine = growth.fine.surface();
  expect_manifold(fine, 1e-6, marker_count(growth.fine));
  EXPECT_NEAR(surface_area(fine) / (std::numbers::pi * radius * radius), 1, 0.01);
  EXPECT_NEAR(surface_area(fine) / surface_area(growth.sheet.mesh), 1, 0.02);
  for (std::size_t t = 0; t < fine.triangle_count(); ++t)
    EXPECT_GT(area_vector(fine, TriId(t)).z(), 0);
}

TEST(FineFront, MarkersKeepTheirSpacing) {
  Growth growth(disc(1, 5));
  for (int frame = 0; frame < 6; ++frame)
    growth.straight_frame(0.9);
  const MarkerCurve& curve = growth.fine.curves()[0];
  std::size_t short_ones = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_LE(curve.spacing(i), 1.51 * kSpacing);
    short_ones += curve.spacing(i) < 0.5 * kSpacing;
  }
  EXPECT_EQ(short_ones, 0u);
  // twice the radius: about twice the markers
  EXPECT_NEAR(static_cast<double>(curve.size()) * kSpacing, 2 * std::numbers::pi * 2.08, 4);
}

TEST(FineFront, AKinkedFrontGoesOnSmoothly) {
  Growth growth(disc(1, 5));
  const auto full = [](NodeId) { return 0.8; };
  growth.frame([](NodeId) { return 1.2; }, full);
  for (NodeId n : growth.sheet.fronts[0].nodes)  // the whole first frame is kinked
    EXPECT_NEAR(growth.sheet.mesh.positions[n].z(), 0.8 * kEdge * std::sin(1.2), 0.02 * kEdge);
  const std::size_t kinked = growth.fine.surface().triangle_count();
  growth.frame([](NodeId) { return -0.6; }, full);
  growth.frame([](NodeId) { return 0.0; }, full);
  growth.fine.finish();
  TriMesh later;  // what was swept after the kink
  later.positions = growth.fine.surface().positions;
  later.corners.assign(growth.fine.surface().corners.begin() + static_cast<std::ptrdiff_t>(kinked),
                       growth.fine.surface().corners.end());
  std::map<std::pair<NodeId, NodeId>, TriId> walked;
  for (std::size_t t = 0; t < later.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& c = later.corners[TriId(t)];
      walked[{c[k], c[(k + 1) % 3]}] = TriId(t);
    }
  double steepest = 0;
  for (const auto& [edge, t] : walked) {
    const auto other = walked.find({edge.second, edge.first});
    if (other == walked.end()) continue;
    steepest = std::max(
        steepest,
        std::acos(std::clamp(unit_normal(later, t).dot(unit_normal(later, other->second)), -1.0, 1.0)));
  }
  EXPECT_LT(steepest, 0.25);  // a turn of 0.6 rad is spread over five sub-steps
  EXPECT_GT(steepest, 0.02);
}

TEST(FineFront, WhereNothingMovesMarkersStop) {
  Growth growth(disc(1, 5));
  for (NodeId n : growth.sheet.fronts[0].nodes)
    if (growth.sheet.mesh.positions[n].x() < 0) growth.sheet.state[n] = FrontState::arrested;
  for (int frame = 0; frame < 3; ++frame)
    growth.straight_frame(0.7);
  for (const Marker& m : growth.fine.curves()[0].markers) {
    const double r = m.position.norm();
    if (m.position.x() < -0.25) {
      EXPECT_LT(r, 1 + 1e-9);
    }
    if (m.position.x() > 0.4) {
      EXPECT_GT(r, 1.35);
    }
  }
  growth.fine.finish();
  expect_manifold(growth.fine.surface(), 1e-6, marker_count(growth.fine));
  expect_agreement(growth);
}

TEST(FineFront, ATougherHalfIsFeltByTheMarkers) {
  Growth growth(disc(1, 5));
  const auto layered = [](const Vec3& x) { return Toughness{x.x() > 0.005 ? 2.5e6 : 1e6, Vec3::Zero()}; };
  const auto steps = steps_of(
      growth.sheet, [](NodeId) { return 0.0; },
      [](NodeId) { return intensity_for(0.75); });  // K_eff = 2 MPa√m
  advance_fronts(growth.sheet, growth.fine, steps, {kLaw, layered}, kEdge);
  for (const Marker& m : growth.fine.curves()[0].markers) {
    if (m.position.x() > 0.02) {
      EXPECT_LT(m.position.norm(), 1 + 1e-9);
    }
    if (m.position.x() < -0.02) {
      EXPECT_NEAR(m.position.norm(), 1 + 0.75 * kEdge, 0.012);
    }
  }
}

TEST(FineFront, UnevenSpeedsStaySoundAndEven) {
  Growth growth(rectangle(2, 2, 10, 10));
  for (int frame = 0; frame < 5; ++frame) {
    growth.frame([](NodeId n) { return 0.2 * std::sin(1.7 * n.value); },
                 [](NodeId n) { return 0.3 + 0.5 * (n.value * 37 % 11) / 10.0; });
    expect_agreement(growth);
  }
  growth.fine.finish();
  expect_manifold(growth.fine.surface(), 1.6, marker_count(growth.fine));
  const SheetFront& front = growth.sheet.fronts[0];
  for (std::size_t i = 0; i < front.nodes.size(); ++i) {
    const double edge = (growth.sheet.mesh.positions[front.nodes[(i + 1) % front.nodes.size()]] -
                         growth.sheet.mesh.positions[front.nodes[i]])
                            .norm();
    EXPECT_GT(edge, 0.15 * kEdge);
    EXPECT_LT(edge, 1.6 * kEdge);
  }
}

TEST(FineFront, TheMirroredCrackHasTheMirroredFineSheet) {
  Growth one(disc(1, 5)), two(mirrored(disc(1, 5)));
  for (int frame = 0; frame < 4; ++frame) {
    const auto share = [](NodeId n) { return 0.3 + 0.6 * (n.value * 7 % 5) / 4.0; };
    const auto angle = [](NodeId n) { return 0.1 * (n.value % 3); };
    one.frame(angle, share);
    two.frame(angle, share);
  }
  const TriMesh &a = one.fine.surface(), b = mirrored(two.fine.surface());
  ASSERT_EQ(a.node_count(), b.node_count());
  ASSERT_EQ(a.triangle_count(), b.triangle_count());
  for (std::size_t i = 0; i < a.node_count(); ++i)
    ASSERT_LT((a.positions[NodeId(i)] - b.positions[NodeId(i)]).norm(), 1e-9);
  EXPECT_EQ(one.sheet.mesh.node_count(), two.sheet.mesh.node_count());
}

TEST(FineFront, ScalingByAPowerOfTwoKeepsTheBits) {
  Growth one(disc(1, 5)),
      two(transformed(disc(1, 5), 8 * Mat3::Identity()), {.resolution = 8 * kEdge, .spacing = 8 * kSpacing});
  for (int frame = 0; frame < 3; ++frame) {
    one.straight_frame(0.55);
    advance_fronts(two.sheet, two.fine,
                   steps_of(
                       two.sheet, [](NodeId) { return 0.0; }, [](NodeId) { return intensity_for(0.55); }),
                   {kLaw, homogeneous}, 8 * kEdge);
  }
  ASSERT_EQ(one.fine.surface().corners, two.fine.surface().corners);
  for (std::size_t i = 0; i < one.fine.surface().node_count(); ++i)
    ASSERT_EQ(two.fine.surface().positions[NodeId(i)], 8 * one.fine.surface().positions[NodeId(i)]);
}

TEST(FineFront, AHoleCloses) {
  TriMesh mesh = disc(1, 5);  // annulus: hole of radius 0.4 growing shut
  mesh.corners.erase(mesh.corners.begin(), mesh.corners.begin() + 24);
  Growth growth(mesh);
  ASSERT_EQ(growth.sheet.fronts.size(), 2u);
  for (NodeId n : growth.sheet.fronts[1].nodes)
    growth.sheet.state[n] = FrontState::arrested;
  for (int frame = 0; frame < 6 && growth.sheet.fronts.size() > 1; ++frame)
    growth.straight_frame(0.6);
  ASSERT_EQ(growth.sheet.fronts.size(), 1u);
  growth.fine.finish();
  expect_manifold(growth.fine.surface(), 1e-6, marker_count(growth.fine));
  EXPECT_NEAR(surface_area(growth.fine.surface()), surface_area(disc(1, 5)), 1e-3);
}

TEST(FineFront, ANewCrackIsTakenIn) {
  Growth growth(disc(1, 5));
  growth.straight_frame(0.5);
  append_part(growth.sheet, transformed(disc(0.4, 2), Mat3::Identity(), {0, 0, 3}));
  growth.straight_frame(0.5);
  ASSERT_EQ(growth.fine.curves().size(), 2u);
  expect_agreement(growth);
  growth.fine.finish();
  expect_manifold(growth.fine.surface(), 1e-6, marker_count(growth.fine));
  const double first = std::numbers::pi * 1.2 * 1.2, second = std::numbers::pi * 0.25;
  EXPECT_NEAR(surface_area(growth.fine.surface()) / (first + second), 1, 0.02);
}

TEST(DrawnNodes, TheNeighbourOutsideFollows) {
  Growth growth(disc(1, 5));
  for (NodeId n : growth.sheet.fronts[0].nodes)
    if (growth.sheet.mesh.positions[n].y() > 1e-9) growth.sheet.state[n] = FrontState::outside;
  const auto steps = steps_of(
      growth.sheet, [](NodeId) { return 0.2; }, [](NodeId) { return intensity_for(0.5); });
  const auto all = with_drawn_nodes(growth.sheet, steps);
  ASSERT_EQ(all.size(), steps.size() + 2);
  EXPECT_DOUBLE_EQ(all.back().angle, 0.2);
  EXPECT_EQ(growth.sheet.state[all.back().node], FrontState::outside);
}
