#include "conchoid/crack/front_joint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "conchoid/crack/advance_fronts.hpp"
#include "crack_samples.hpp"

// Fronts that meet become one.
using namespace conchoid;
using namespace conchoid::testing;

namespace {

constexpr double kEdge = 0.2, kSpacing = 0.02, kToughness = 1e6;

Toughness homogeneous(const Vec3&) {
  return {kToughness, Vec3::Zero()};
}

struct Growth {
  CrackSheet sheet;
  FineFront fine;
  std::optional<FineFront> led;

  explicit Growth(const std::vector<TriMesh>& parts, std::optional<double> led_spacing = std::nullopt)
      : sheet([&] {
          CrackSheet s;
          for (const TriMesh& part : parts)
            append_part(s, part);
          return s;
        }()),
        fine(sheet, {.resolution = kEdge, .spacing = kSpacing}) {
    if (led_spacing) led.emplace(sheet, FineFrontSettings{.resolution = kEdge, .spacing = *led_spacing});
  }

  /// Straight on by the given share of r̄.
  void frame(double share) {
    std::vector<FrontStep> steps;
    for (const SheetFront& front : sheet.fronts) {
      const auto frames = front_frames(sheet, front);
      for (std::size_t i = 0; i < front.nodes.size(); ++i)
        if (sheet.state[front.nodes[i]] == FrontState::active)
          steps.push_back({front.nodes[i], frames[i], 0, kToughness / std::sqrt(1 - share)});
    }
    advance_fronts(sheet, fine, steps, homogeneous, kEdge, led ? &*led : nullptr);
  }
};

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
  if (growth.led) {
    EXPECT_EQ(boundary_edges(growth.led->surface()), marker_count(*growth.led));
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
  for (const double shift : {0.0, 0.07, 0.31}) {
    Growth growth({disc_at(0.6, 3, {-0.9, 0, 0}), disc_at(0.6, 3, {0.9, shift, 0})}, kSpacing / 2);
    double radius = 0.6;
    for (int frame = 0; frame < 9; ++frame) {
      SCOPED_TRACE(::testing::Message() << "shift " << shift << " frame " << frame);
      growth.frame(0.6);
      radius += 0.6 * kEdge;
      expect_sound(growth);
    }
    ASSERT_EQ(growth.sheet.fronts.size(), 1u);
    ASSERT_EQ(growth.fine.curves().size(), 1u);
    const double exact = united_area(radius, std::hypot(1.8, shift));
    EXPECT_NEAR(surface_area(growth.sheet.mesh) / exact, 1, 0.04);
    EXPECT_NEAR(surface_area(growth.fine.surface()) / exact, 1, 0.04);
    EXPECT_NEAR(surface_area(growth.led->surface()) / surface_area(growth.fine.surface()), 1, 0.005);
    const auto& front = growth.sheet.fronts[0];
    for (const NodeId n : front.nodes)
      EXPECT_EQ(growth.sheet.state[n], FrontState::active);
    std::map<NodeId, Vec3> rides;
    for (const Marker& m : growth.fine.curves()[0].markers)
      if (m.coarse.valid()) rides.emplace(m.coarse, m.position);
    for (const NodeId n : front.nodes)
      EXPECT_LT((rides.at(n) - growth.sheet.mesh.positions[n]).norm(), 1e-12);
  }
}
