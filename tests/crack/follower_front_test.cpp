#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/crack/fine/front_track.hpp"
#include "conchoid/crack/fine/marker_curve.hpp"
#include "crack_samples.hpp"
#include "growth.hpp"

// A fine front of another spacing that follows the one which moves the crack.
using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// A ring of the given number of markers around the unit circle; every `per`-th has a coarse node attached.
MarkerCurve ring(int count, int per) {
  MarkerCurve curve;
  curve.closed = true;
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * std::numbers::pi * i / count;
    Marker marker;
    marker.position = {std::cos(phi), std::sin(phi), 0};
    if (i % per == 0) marker.coarse = NodeId(static_cast<std::size_t>(i / per));
    curve.markers.push_back(marker);
  }
  return curve;
}

std::vector<NodeId> node_ids(std::size_t count) {
  std::vector<NodeId> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(NodeId(i));
  return out;
}

double smooth_field(const Vec3& x) {
  return 1 + 0.3 * std::sin(9 * x.x()) * std::cos(7 * x.y()) + 0.2 * std::sin(8 * x.z() + 1);
}

Toughness varied(const Vec3& x) {
  constexpr double kStep = 1e-5;
  Toughness out{kToughness * smooth_field(x), Vec3::Zero()};
  for (int k = 0; k < 3; ++k) {
    Vec3 up = x, down = x;
    up[k] += kStep;
    down[k] -= kStep;
    out.gradient[k] = kToughness * (smooth_field(up) - smooth_field(down)) / (2 * kStep);
  }
  return out;
}

/// A disc that grows and twists, with a follower front or without.
struct TwistingDisc : Growth {
  explicit TwistingDisc(std::optional<double> follower_spacing) : Growth({disc(0.6, 3)}, follower_spacing) {}

  void frame(const ToughnessField& toughness) {
    const auto& x = sheet.mesh.positions;
    advance(steps_of(
                sheet, [&](NodeId n) { return 0.3 * x[n].y() + 0.1; },
                [&](NodeId n) { return (1.8 + 0.4 * x[n].x()) * kToughness; }),
            toughness);
  }
};

/// Mean distance of the markers of one front from the other, and the largest.
struct Apart {
  double mean = 0, largest = 0;
};
Apart apart(const MarkerCurve& from, const MarkerCurve& to) {
  Apart out;
  for (const Marker& m : from.markers) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < to.size(); ++i) {
      const Vec3 &a = to.markers[i].position, &b = to.markers[to.next(i)].position;
      const double s = std::clamp((m.position - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (m.position - a - s * (b - a)).norm());
    }
    out.mean += nearest / static_cast<double>(from.size());
    out.largest = std::max(out.largest, nearest);
  }
  return out;
}

}  // namespace

TEST(FrontTrack, IsLinearBetweenMarkersAndTimesAndGoesRound) {
  MarkerCurve curve = ring(8, 2);
  set_parameters(curve, node_ids(4));
  std::vector<Vec3> flat, raised;
  for (const Marker& m : curve.markers) {
    flat.push_back(m.position);
    raised.push_back(m.position + Vec3(0, 0, 1));
  }
  FrontTrack track;
  EXPECT_TRUE(track.empty());
  track.add(0.25, curve, flat, 4);
  track.add(1, curve, raised, 4);
  const Vec3 last = curve.markers[7].position, first = curve.markers[0].position;
  EXPECT_LT((track.at(0.5, 0.25) - curve.markers[1].position).norm(), 1e-15);
  EXPECT_LT((track.at(3.75, 0.25) - 0.5 * (last + first)).norm(), 1e-12);
  EXPECT_LT((track.at(0.5, 0.625) - curve.markers[1].position - Vec3(0, 0, 0.5)).norm(), 1e-12);
  EXPECT_EQ(track.at(1, 0).z(), 0);  // before the first time it knows
}

TEST(FrontTrack, AnOpenFrontEndsAtItsEnds) {
  MarkerCurve curve = ring(4, 1);
  curve.closed = false;
  set_parameters(curve, node_ids(4));
  std::vector<Vec3> positions;
  for (const Marker& m : curve.markers)
    positions.push_back(m.position);
  FrontTrack track;
  track.add(0, curve, positions, 4);
  EXPECT_EQ(track.at(3, 0.5), positions[3]);
  EXPECT_EQ(track.at(7, 0.5), positions[3]);
  EXPECT_EQ(track.at(-1, 0.5), positions[0]);
}

TEST(AttachedNodes, FollowNodesThatMovedAlongTheFront) {
  constexpr int kCount = 80, kPer = 10;
  MarkerCurve curve = ring(kCount, kPer);
  IdVector<NodeId, Vec3> nodes;
  for (int k = 0; k < kCount / kPer; ++k) {
    const double phi = 2 * std::numbers::pi * (k * kPer + (k % 2 ? 2.3 : -1.2)) / kCount;
    nodes.add(Vec3(1.02 * std::cos(phi), 1.02 * std::sin(phi), 0.01));
  }
  reattach_nodes(curve, node_ids(8), nodes);
  set_parameters(curve, node_ids(8));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Marker& m = curve.markers[i];
    const double phi = std::atan2(m.position.y(), m.position.x()) * kCount / (2 * std::numbers::pi);
    const double at = phi < -1.2 ? phi + kCount : phi;  // in markers, from the first node on
    double expected = -1;
    for (int node = 0; node < 8; ++node) {
      const double from = node * kPer + (node % 2 ? 2.3 : -1.2),
                   to = (node + 1) * kPer + (node % 2 ? -1.2 : 2.3);
      if (at >= from - 1e-9 && at < to) expected = node + (at - from) / (to - from);
    }
    EXPECT_NEAR(m.parameter, expected, 0.02) << i;
  }
  EXPECT_TRUE(std::is_sorted(curve.markers.begin(), curve.markers.end(),
                             [](const Marker& a, const Marker& b) { return a.parameter < b.parameter; }));
}

TEST(FollowerFront, HasNoEffectOnTheCrack) {
  for (const ToughnessField& field : {ToughnessField(homogeneous), ToughnessField(varied)}) {
    TwistingDisc alone(std::nullopt), with(kEdge / 25);
    for (int frame = 0; frame < 5; ++frame) {
      alone.frame(field);
      with.frame(field);
    }
    ASSERT_EQ(alone.sheet.mesh.node_count(), with.sheet.mesh.node_count());
    for (std::size_t i = 0; i < alone.sheet.mesh.node_count(); ++i)
      ASSERT_EQ(alone.sheet.mesh.positions[NodeId(i)], with.sheet.mesh.positions[NodeId(i)]);
    EXPECT_EQ(alone.fine.surface().corners, with.fine.surface().corners);
  }
}

// Whatever its spacing: over many frames it stays with the front it follows.
TEST(FollowerFront, StaysWithTheFrontItFollows) {
  for (const double share : {0.25, 0.2, 0.05, 0.025})
    for (const bool structure : {false, true}) {
      TwistingDisc growth(share * kEdge);
      for (int frame = 0; frame < 7; ++frame)
        growth.frame(structure ? ToughnessField(varied) : ToughnessField(homogeneous));
      const Apart off = apart(growth.follower->curves()[0], growth.fine.curves()[0]);
      EXPECT_LT(off.mean, 0.01 * kEdge) << share;
      EXPECT_LT(off.largest, 0.04 * kEdge) << share;
      const MarkerCurve& curve = growth.follower->curves()[0];
      const double h = std::min(share, 0.25) * kEdge;
      for (std::size_t i = 0; i < curve.size(); ++i)
        EXPECT_LT(curve.spacing(i), 1.6 * h);
    }
}
