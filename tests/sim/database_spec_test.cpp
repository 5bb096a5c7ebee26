#include "conchoid/sim/database_spec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "refusal.hpp"

using namespace conchoid;

namespace {

const std::string kCommon =
    "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
    "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [1e6, 2e6]\n";

DatabaseSpec parse(const std::string& text) {
  return parse_database_spec(text, "spec.toml", ".");
}

std::string error_of(const std::string& text) {
  return test::refusal([&] { parse(text); });
}

}  // namespace

TEST(DatabaseSpec, StandardValuesAreThePublishedOnes) {
  const DatabaseSpec spec = parse(kCommon);
  EXPECT_EQ(spec.exclusion.frame_limit, 31);
  EXPECT_EQ(spec.scene.run.frames, 31);
  EXPECT_EQ(spec.exclusion.alpha_limit, ExclusionSettings{}.alpha_limit);
  EXPECT_EQ(spec.exclusion.many_cracks, ExclusionSettings{}.many_cracks);
  EXPECT_EQ(spec.exclusion.tiny_growth, ExclusionSettings{}.tiny_growth);
}

TEST(DatabaseSpec, LoadsLieInTheirIntervalsAndFillThem) {
  const DatabaseSpec spec = parse(kCommon + "slope = [10, 80]\n");
  double least = 90, most = 0;
  for (int run = 0; run < 500; ++run) {
    const DrawnLoad load = draw_load(spec, run);
    EXPECT_GE(load.magnitude, 1e6);
    EXPECT_LE(load.magnitude, 2e6);
    EXPECT_NEAR(load.direction.norm(), 1, 1e-14);
    EXPECT_NEAR(std::acos(load.direction.z()) * 180 / std::numbers::pi, load.slope, 1e-9);
    EXPECT_NEAR(
        std::remainder(
            std::atan2(load.direction.y(), load.direction.x()) * 180 / std::numbers::pi - load.rotation, 360),
        0, 1e-9);
    least = std::min(least, load.slope);
    most = std::max(most, load.slope);
  }
  EXPECT_GE(least, 10);
  EXPECT_LT(least, 12);
  EXPECT_LE(most, 80);
  EXPECT_GT(most, 78);
}

TEST(DatabaseSpec, ARunIsTheSameWhateverTheNumberOfRuns) {
  const DatabaseSpec few = parse(kCommon + "runs = 10\n"), many = parse(kCommon + "runs = 1000\n");
  for (int run : {9, 0, 4})
    EXPECT_EQ(draw_load(few, run).direction, draw_load(many, run).direction);
  EXPECT_NE(draw_load(few, 1).direction, draw_load(parse(kCommon + "seed = 2\n"), 1).direction);
}

TEST(DatabaseSpec, ALoadOnOneRegionAloneHasNoOpposite) {
  std::string text = kCommon;
  text.replace(text.find("[\"z+\", \"z-\"]"), 12, "[\"z+\"]");
  text.insert(text.find("[database]"), "[[boundary]]\nregion = \"z-\"\nfixed = true\n");
  const DatabaseSpec spec = parse(text);
  const Scene scene = loaded_scene(spec, draw_load(spec, 3));
  ASSERT_EQ(scene.boundary.size(), 2u);
  EXPECT_EQ(scene.boundary[1].region, "z+");
  EXPECT_FALSE(scene.run.inertia_relief);
}

TEST(DatabaseSpec, TheLoadIsMirroredAndBalancedByInertia) {
  const DatabaseSpec spec = parse(kCommon);
  const DrawnLoad load = draw_load(spec, 3);
  const Scene scene = loaded_scene(spec, load);
  ASSERT_EQ(scene.boundary.size(), 2u);
  EXPECT_EQ(scene.boundary[0].value, -scene.boundary[1].value);
  EXPECT_NEAR(scene.boundary[0].value.norm(), load.magnitude, 1e-6);
  EXPECT_TRUE(scene.run.inertia_relief);
}

TEST(DatabaseSpec, SomethingHeldNeedsNoInertia) {
  const DatabaseSpec spec = parse(kCommon + "[[boundary]]\nregion = \"x-\"\nfixed = true\n");
  EXPECT_FALSE(loaded_scene(spec, draw_load(spec, 0)).run.inertia_relief);
}

TEST(DatabaseSpec, MistakesAreNamedWithTheirPlace) {
  const std::string without = kCommon.substr(0, kCommon.find("[database]"));
  EXPECT_NE(error_of(without).find("[database]"), std::string::npos);
  EXPECT_NE(error_of(without + "[database]\nregions = [\"z+\", \"z-\"]\n")
                .find("spec.toml:6: [database] lacks magnitude"),
            std::string::npos);
  EXPECT_NE(
      error_of(without + "[database]\nmagnitude = [1, 2]\nregions = [\"z+\", \"z+\"]\n").find("spec.toml:8"),
      std::string::npos);
  EXPECT_NE(error_of(without + "[database]\nmagnitude = [1, 2]\nregions = [\"z+\", \"up\"]\n").find("\"up\""),
            std::string::npos);
  EXPECT_NE(error_of(without + "[database]\nmagnitude = [2, 1]\nregions = [\"z+\", \"z-\"]\n")
                .find("smaller value first"),
            std::string::npos);
  EXPECT_NE(error_of(kCommon + "[run]\nframes = 20\n").find("spec.toml:10"), std::string::npos);
  EXPECT_NE(
      error_of(kCommon + "[[boundary]]\nregion = \"z-\"\nfixed = true\n").find("already has a condition"),
      std::string::npos);
}
