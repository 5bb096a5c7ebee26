#include "conchoid/crack/fine/front_smoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// Markers on a unit circle, with a wave of the given number of periods in their height.
MarkerCurve ring(int count, int waves, double height) {
  MarkerCurve curve;
  curve.closed = true;
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * std::numbers::pi * i / count;
    Marker marker;
    marker.position = {std::cos(phi), std::sin(phi), height * std::sin(waves * phi)};
    curve.markers.push_back(marker);
  }
  return curve;
}

TEST(FrontSmoothing, ASmoothFrontStaysWhatItIs) {
  const MarkerCurve curve = ring(400, 0, 0);
  for (const Vec3& x : smoothed_positions(curve, 0.2)) {
    EXPECT_NEAR(x.head<2>().norm(), 1, 2e-4);  // the plain mean over ±0.2 would lie 0.003 inside
    EXPECT_EQ(x.z(), 0);
  }
}

TEST(FrontSmoothing, DetailFinerThanTheWidthGoesAndCoarserStays) {
  const auto left = [](int waves) {
    double most = 0;
    for (const Vec3& x : smoothed_positions(ring(800, waves, 0.001), 0.2))
      most = std::max(most, std::abs(x.z()));
    return most / 0.001;
  };
  EXPECT_GT(left(4), 0.95);   // wavelength 1.57: eight widths
  EXPECT_LT(left(31), 0.05);  // one width
  EXPECT_LT(left(63), 0.05);  // half a width
}

TEST(FrontSmoothing, TheEndsOfAnOpenFrontStay) {
  MarkerCurve curve;
  for (int i = 0; i <= 50; ++i) {
    Marker marker;
    marker.position = {0.02 * i, i % 2 ? 0.01 : 0.0, 0};
    curve.markers.push_back(marker);
  }
  const auto smooth = smoothed_positions(curve, 0.1);
  EXPECT_EQ(smooth.front(), curve.markers.front().position);
  EXPECT_EQ(smooth.back(), curve.markers.back().position);
  EXPECT_NEAR(smooth[25].y(), 0.005, 1e-3);
}

TEST(FrontSmoothing, NeighboursInARowAgree) {
  const MarkerCurve curve = ring(8, 0, 0);
  std::vector<double> values = {1, -1, 1, -1, 1, -1, 1, -1};
  smooth_along(curve, std::vector<bool>(8, true), values);
  for (double v : values)
    EXPECT_EQ(v, 0);
  std::vector<double> alone = {1, -1, 1, -1, 1, -1, 1, -1};
  smooth_along(curve, {false, true, true, false, false, true, true, false}, alone);
  EXPECT_EQ(alone, (std::vector<double>{1, -1, 1, -1, 1, -1, 1, -1}));  // no three in a row
}

TEST(ToughnessDeflection, GoesToTheWeakerSideAndNoFurtherThanTheIntensityAllows) {
  EXPECT_EQ(toughness_deflection(0, 2e6, 1e6), 0);
  EXPECT_EQ(toughness_deflection(1, 1e6, 1e6), 0);  // nothing to spare
  EXPECT_EQ(toughness_deflection(0.3, 2e6, 1e6), -toughness_deflection(-0.3, 2e6, 1e6));
  const double widest = 2 * std::acos(std::cbrt(0.5));
  EXPECT_NEAR(toughness_deflection(1e6, 2e6, 1e6), std::min(widest, std::acos(1.0 / 3)), 1e-6);
  EXPECT_NEAR(hoop_intensity({1.1e6, 0, 0}, toughness_deflection(1e6, 1.1e6, 1e6)), 1e6,
              10);                                                             // just enough is left
  EXPECT_NEAR(toughness_deflection(1e9, 1e9, 1e6), std::acos(1.0 / 3), 1e-6);  // 70.5° at most
  EXPECT_LT(toughness_deflection(0.1, 2e6, 1e6), toughness_deflection(0.2, 2e6, 1e6));
}

constexpr double kEdge = 0.2, kSpacing = 0.02;

/// A disc grown under K_eff = 2 MPa√m, straight ahead as far as the load is concerned.
struct Grown {
  CrackSheet sheet;
  FineFront fine;
  Grown(const ToughnessField& toughness, int frames)
      : sheet([&] {
          CrackSheet s;
          append_part(s, disc(1, 5));
          return s;
        }()),
        fine(sheet, {.resolution = kEdge, .spacing = kSpacing}) {
    for (int frame = 0; frame < frames; ++frame) {
      std::vector<FrontStep> steps;
      for (const SheetFront& front : sheet.fronts) {
        const auto frames_of = front_frames(sheet, front);
        for (std::size_t i = 0; i < front.nodes.size(); ++i)
          steps.push_back({front.nodes[i], frames_of[i], 0, 2e6});
      }
      advance_fronts(sheet, fine, steps, {kLaw, toughness}, kEdge);
    }
    fine.finish();
  }
};

/// Weakest at the height `valley`, 40 % tougher at its distance and beyond.
ToughnessField valley_at(double valley) {
  return [=](const Vec3& x) {
    const double d = (x.z() - valley) / 0.1;
    return Toughness{1e6 * (1.4 - 0.4 * std::exp(-d * d)),
                     1e6 * 0.4 * std::exp(-d * d) * 2 * d / 0.1 * Vec3::UnitZ()};
  };
}

TEST(VaryingToughness, MarkersGoToTheValleyAndStayInIt) {
  const Grown grown(valley_at(0.05), 4);
  double least = 1, most = -1;
  for (const Marker& m : grown.fine.curves()[0].markers) {
    least = std::min(least, m.position.z());
    most = std::max(most, m.position.z());
  }
  EXPECT_GT(least, 0.02);
  EXPECT_LT(most, 0.08);
  // no zigzag: no triangle of the sheet turned from its neighbour by more than 45°, none flat
  const TriMesh& fine = grown.fine.surface();
  for (std::size_t t = 0; t < fine.triangle_count(); ++t) {
    EXPECT_GT(area_vector(fine, TriId(t)).norm(), 0);
    EXPECT_GT(unit_normal(fine, TriId(t)).z(), 0.4);
  }
}

TEST(VaryingToughness, ToughSpotsAreOvertakenAndNotLeftBehind) {
  // Spots smaller than a crack edge and tougher than the load can break by itself.
  const ToughnessField spots = [](const Vec3& x) {
    const double k = 2 * std::numbers::pi / 0.15, sx = std::sin(k * x.x()), sy = std::sin(k * x.y());
    return Toughness{1e6 * (1.4 + 0.8 * sx * sy),
                     0.8e6 * k * Vec3(std::cos(k * x.x()) * sy, sx * std::cos(k * x.y()), 0)};
  };
  const Grown grown(spots, 6);
  for (const Marker& m : grown.fine.curves()[0].markers) {
    EXPECT_GT(m.position.norm(), 1.3);
    EXPECT_LT(std::abs(m.position.z()), 1e-9);
  }
}

TEST(VaryingToughness, TheCoarseFrontIsTheFineOneSmoothed) {
  const Grown grown(valley_at(0.05), 3);
  ASSERT_EQ(grown.sheet.fronts.size(), 1u);
  const MarkerCurve& curve = grown.fine.curves()[0];
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (const NodeId node = curve.markers[i].coarse; node.valid()) {
      EXPECT_LT((grown.sheet.mesh.positions[node] - curve.markers[i].position).norm(), 0.1 * kEdge);
    }
}

}  // namespace
