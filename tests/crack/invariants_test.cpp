#include "conchoid/crack/invariants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "crack_samples.hpp"
#include "growth.hpp"

// Growth (growth.hpp) validates itself after every frame; here scenes that meet in any way, and what is broken.
using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// Whether one of the violations says this.
bool says(const std::vector<std::string>& violations, const std::string& what) {
  return std::any_of(violations.begin(), violations.end(),
                     [&](const std::string& v) { return v.find(what) != std::string::npos; });
}

std::vector<std::string> curve_violations(const Growth& growth, const MarkerCurve& curve) {
  return conchoid::curve_violations(growth.sheet, growth.sheet.fronts[0], curve, growth.fine.surface(), kEdge,
                                    kSpacing, growth.fine.longest_spacing());
}

Growth grown_disc() {
  Growth growth(disc(0.6, 3));
  growth.straight_frame(0.6);
  return growth;
}

}  // namespace

TEST(Invariants, HoldForRandomDiscsThatMeet) {
  std::size_t joined = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<TriMesh> parts;
    for (const double x : {-1.0, 0.0, 1.0})
      parts.push_back(
          transformed(disc(0.35, 2), Mat3::Identity(), {x, 0.4 * any(random), 0.05 * any(random)}));
    Growth growth(parts, seed % 2 ? std::optional(kSpacing / 2) : std::nullopt);
    const ToughnessField rough = [&](const Vec3& x) {
      return Toughness{kToughness * (1 + 0.2 * std::sin(9 * x.x())),
                       1.8 * kToughness * std::cos(9 * x.x()) * Vec3::UnitX()};
    };
    for (int frame = 0; frame < 6; ++frame) {
      const auto steps = steps_of(
          growth.sheet, [&](NodeId) { return 0.2 * any(random); },
          [&](NodeId) { return intensity_for(0.45 + 0.4 * any(random)); });
      ASSERT_NO_THROW(growth.advance(steps, seed > 3 ? rough : ToughnessField(homogeneous)));
    }
    joined += growth.sheet.fronts.size() < 3 ? 1 : 0;
  }
  EXPECT_GT(joined, 3u);
}

TEST(Invariants, OfTheSheetAreMissed) {
  const CrackSheet whole = grown_disc().sheet;
  EXPECT_TRUE(sheet_violations(whole).empty());
  const auto broken = [&](auto change) {
    CrackSheet sheet = whole;
    change(sheet);
    return sheet_violations(sheet);
  };
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.state.resize(3); }), "one value per node"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.triangle_birth.resize(3); }), "not one birth"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.node_birth[NodeId(0)] = 1; }), "births decrease"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.frame = 0; }), "after the present frame"));
  EXPECT_TRUE(says(
      broken([](CrackSheet& s) { std::reverse(s.fronts[0].nodes.begin() + 1, s.fronts[0].nodes.end()); }),
      "no boundary edge"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.fronts[0].nodes[1] = NodeId(0); }), "smallest id"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.fronts.push_back(s.fronts[0]); }), "on a front already"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.correlation[s.fronts[0].nodes[2]] = s.fronts[0].nodes[2]; }),
                   "correlation node"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.travelled[s.fronts[0].nodes[2]] = -1; }), "way travelled"));
  EXPECT_TRUE(says(broken([](CrackSheet& s) { s.mesh.corners.push_back(s.mesh.corners[TriId(0)]); }),
                   "not one birth"));
}

TEST(Invariants, OfMarkersAreMissed) {
  const Growth growth = grown_disc();
  const MarkerCurve whole = growth.fine.curves()[0];
  EXPECT_TRUE(curve_violations(growth, whole).empty());
  const auto broken = [&](auto change) {
    MarkerCurve curve = whole;
    change(curve.markers);
    return curve_violations(growth, curve);
  };
  using Markers = std::vector<Marker>;
  const auto second = [](Markers& markers) {  // the second one with a node attached
    auto at = std::find_if(markers.begin(), markers.end(), [](const Marker& m) { return m.coarse.valid(); });
    return std::find_if(at + 1, markers.end(), [](const Marker& m) { return m.coarse.valid(); });
  };
  const NodeId first = growth.sheet.fronts[0].nodes[0];
  EXPECT_TRUE(says(broken([](Markers& m) { std::swap(m[3], m[4]); }), "no boundary edge"));
  EXPECT_TRUE(says(broken([](Markers& m) { m.erase(m.begin() + 3); }), "no boundary edge"));
  EXPECT_TRUE(says(broken([](Markers& m) { m[3].node = NodeId(); }), "no node of the fine surface"));
  EXPECT_TRUE(says(broken([](Markers& m) { m[3].position.z() += kSpacing; }), "ahead of its row"));
  EXPECT_TRUE(says(broken([](Markers& m) { m[3].parameter = 7; }), "parameters fall"));
  EXPECT_TRUE(says(broken([](Markers& m) { m[3].coarse = NodeId(0); }), "another front"));
  EXPECT_TRUE(says(broken([&](Markers& m) { m[3].coarse = m[60].coarse = first; }), "order of the front"));
  EXPECT_TRUE(
      says(broken([&](Markers& m) { m[m.size() / 2].coarse = second(m)->coarse; }), "farther than r̄"));
  MarkerCurve open = whole;
  open.closed = false;
  EXPECT_TRUE(says(curve_violations(growth, open), "open along a ring"));
}

TEST(Invariants, TheMessageSaysFrameAndPlace) {
  Growth growth = grown_disc();
  const Growth other(std::vector{disc(0.6, 3), transformed(disc(0.6, 3), Mat3::Identity(), {3, 0, 0})});
  EXPECT_NO_THROW(validate(growth.sheet, growth.fine));
  EXPECT_THROW(validate(growth.sheet, other.fine), std::logic_error);
  growth.sheet.travelled[growth.sheet.fronts[0].nodes[0]] = -1;
  try {
    validate(growth.sheet, growth.fine);
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_TRUE(says({error.what()}, "after frame 1"));
    EXPECT_TRUE(says({error.what()}, "front 0, node"));
  }
}
