#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "arbitrary_rotation.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/material/material_field.hpp"
#include "material/sample_grids.hpp"

namespace conchoid {
namespace {

struct Kind {
  const char* name;
  FieldFactor factor;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

const Layers kLayers{.direction = Vec3(0.6, 0, 0.8), .wavelength = 0.3, .amplitude = 0.4, .phase = 0.1};
const Noise kNoise{.wavelength = 0.4, .amplitude = 0.5, .octaves = 4, .gain = 0.6, .seed = 7};
const Grains kGrains{
    .size = 0.35, .stretch = {1, 1, 2}, .width = 0.1, .weakening = 0.6, .spread = 0.4, .seed = 3};
const Grains kThinBoundaries{.size = 0.35, .width = 0.02, .weakening = 0.8, .spread = 0.3, .seed = 4};

const std::vector<Kind> kKinds = {
    {"layers", {kLayers, {}}},
    {"noise", {kNoise, {}}},
    {"grains", {kGrains, {}}},
    {"thin_boundaries", {kThinBoundaries, {}}},
    {"clamped", {Voxels{test::random_grid(), 0.8, Outside::clamped}, {}}},
    {"periodic", {Voxels{test::random_grid(), 0.8, Outside::periodic}, {}}},
    {"placed", {kGrains, {Vec3(0.3, 0.1, -0.2), test::arbitrary_rotation()}}},
};

Vec3 random_point(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

class FieldKind : public testing::TestWithParam<Kind> {};

// Central differences at two steps, extrapolated; compared with the largest gradient met.
void expect_consistent(const MaterialField& field, double step) {
  Random random(11);
  double largest = 0, worst = 0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 x = random_point(random);
    const FieldSample at = field.at(x);
    ASSERT_GT(at.value, 0);
    largest = std::max(largest, at.gradient.norm());
    for (int k = 0; k < 3; ++k) {
      const auto difference = [&](double h) {
        return (field.at(x + h * Vec3::Unit(k)).value - field.at(x - h * Vec3::Unit(k)).value) / (2 * h);
      };
      const double slope = (4 * difference(step / 2) - difference(step)) / 3;
      worst = std::max(worst, std::abs(slope - at.gradient[k]));
    }
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(worst, 1e-5 * largest);
}

TEST_P(FieldKind, TheGradientIsThatOfTheValue) {
  expect_consistent(MaterialField({GetParam().factor}, Vec3::Zero()), 1e-5);
}

TEST_P(FieldKind, ValueAndGradientAreContinuousAlongALine) {
  const MaterialField field({GetParam().factor}, Vec3::Zero());
  const Vec3 from(-0.9, -0.71, -0.83), along = Vec3(0.81, 0.93, 0.77).normalized();
  constexpr double kStep = 1e-6;
  double steepest = 0;
  for (double s : {0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4})  // stretches of a thousand steps
    for (int i = 0; i < 1000; ++i) {
      const FieldSample a = field.at(from + (s + i * kStep) * along);
      const FieldSample b = field.at(from + (s + (i + 1) * kStep) * along);
      EXPECT_LT(std::abs(b.value - a.value - 0.5 * kStep * along.dot(a.gradient + b.gradient)), 1e-9);
      steepest = std::max(steepest, (b.gradient - a.gradient).norm());
    }
  EXPECT_LT(steepest, 0.1);
}

TEST_P(FieldKind, ScalingByAPowerOfTwoKeepsTheBits) {
  FieldFactor large = GetParam().factor;
  constexpr double k = 8;
  if (auto* layers = std::get_if<Layers>(&large.kind)) layers->wavelength *= k;
  if (auto* noise = std::get_if<Noise>(&large.kind)) noise->wavelength *= k;
  if (auto* voxels = std::get_if<Voxels>(&large.kind)) voxels->scale *= k;
  if (auto* grains = std::get_if<Grains>(&large.kind)) {
    grains->size *= k;
    grains->width *= k;
  }
  if (large.placement.origin) *large.placement.origin *= k;
  const MaterialField here({GetParam().factor}, Vec3::Zero()), there({large}, Vec3::Zero());
  Random random(5);
  for (int n = 0; n < 500; ++n) {
    const Vec3 x = random_point(random);
    const FieldSample a = here.at(x), b = there.at(k * x);
    ASSERT_EQ(a.value, b.value);
    ASSERT_EQ(a.gradient, k * b.gradient);
  }
}

TEST_P(FieldKind, TurnsWithTheBody) {
  FieldFactor turned = GetParam().factor;
  Mat3 turn = test::arbitrary_rotation();
  turn.col(0) *= -1;  // and mirrors
  turned.placement.axes = turn * turned.placement.axes;
  if (turned.placement.origin) turned.placement.origin = turn * *turned.placement.origin;
  const MaterialField here({GetParam().factor}, Vec3::Zero()), there({turned}, Vec3::Zero());
  Random random(6);
  for (int n = 0; n < 500; ++n) {
    const Vec3 x = random_point(random);
    const FieldSample a = here.at(x), b = there.at(turn * x);
    ASSERT_NEAR(a.value, b.value, 1e-12 * a.value);
    ASSERT_LT((turn * a.gradient - b.gradient).norm(), 1e-9 * (1 + a.gradient.norm()));
  }
}

TEST_P(FieldKind, StaysWithTheBodyWhereverItIs) {
  const Vec3 far = 1e4 * Vec3(0.6, -0.48, 0.64);
  FieldFactor moved = GetParam().factor;
  if (moved.placement.origin) *moved.placement.origin += far;
  const MaterialField here({GetParam().factor}, Vec3::Zero()), there({moved}, far);
  const Vec3 x(0.123, -0.3, 0.21);
  EXPECT_NEAR(here.at(x).value, there.at(x).value, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Fields, FieldKind, testing::ValuesIn(kKinds),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Field, ProductsMultiply) {
  const MaterialField a({{kLayers, {}}}, Vec3::Zero()), b({{kNoise, {}}}, Vec3::Zero());
  const MaterialField both({{kLayers, {}}, {kNoise, {}}}, Vec3::Zero());
  Random random(8);
  for (int n = 0; n < 100; ++n) {
    const Vec3 x = random_point(random);
    EXPECT_DOUBLE_EQ(both.at(x).value, a.at(x).value * b.at(x).value);
  }
  expect_consistent(both, 1e-4);
}

TEST(Field, WithoutFactorsItIsOne) {
  const MaterialField field;
  EXPECT_TRUE(field.homogeneous());
  EXPECT_EQ(field.at(Vec3(1, 2, 3)).value, 1);
  EXPECT_EQ(field.at(Vec3(1, 2, 3)).gradient, Vec3::Zero());
}

TEST(Layers, RepeatEveryWavelengthAlongTheirDirectionOnly) {
  const Vec3 x(0.2, -0.4, 0.1), across = Vec3(0.8, 0, -0.6);
  EXPECT_NEAR(kLayers.at(x).value, kLayers.at(x + 0.3 * kLayers.direction).value, 1e-12);
  EXPECT_NEAR(kLayers.at(x).value, kLayers.at(x + 0.17 * across).value, 1e-12);
  EXPECT_NEAR(kLayers.at((0.1 + 0.25) * 0.3 * kLayers.direction).value, 1.4, 1e-12);
  EXPECT_NEAR(kLayers.at((0.1 + 0.75) * 0.3 * kLayers.direction).value, 0.6, 1e-12);
}

// Mean, spread and wavelength are what the scene asked for.
TEST(Noise, HasTheStatisticsAskedFor) {
  for (int octaves : {1, 4}) {
    Noise noise{.wavelength = 0.3, .amplitude = 0.4, .octaves = octaves, .gain = 0.5, .seed = 2};
    Random random(9);
    double sum = 0, squares = 0, slopes = 0;
    constexpr int kPoints = 60000;
    for (int n = 0; n < kPoints; ++n) {
      const FieldSample f = noise.at(20 * random_point(random));
      const double log = std::log(f.value), slope = f.gradient[0] / f.value;
      sum += log;
      squares += log * log;
      slopes += slope * slope;
    }
    const double deviation = std::sqrt(squares / kPoints);
    EXPECT_NEAR(sum / kPoints, 0, 0.01);
    EXPECT_NEAR(deviation / 0.4, 1, 0.02) << octaves;
    const double wavelength = 2 * std::numbers::pi * deviation / std::sqrt(slopes / kPoints);
    if (octaves == 1)
      EXPECT_NEAR(wavelength / 0.3, 1, 0.02);
    else
      EXPECT_LT(wavelength, 0.25);
  }
}

TEST(Noise, OtherSeedsAreUnrelated) {
  Noise a{.wavelength = 0.3, .amplitude = 0.4, .seed = 1}, b = a;
  b.seed = 2;
  Random random(10);
  double product = 0, squares = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 x = 20 * random_point(random);
    product += std::log(a.at(x).value) * std::log(b.at(x).value);
    squares += std::log(a.at(x).value) * std::log(a.at(x).value);
  }
  EXPECT_LT(std::abs(product / squares), 0.03);
}

TEST(Grains, BoundariesAreWeakAndGrainsAreNot) {
  const Grains g{.size = 0.5, .width = 0.05, .weakening = 0.7, .spread = 0, .seed = 3};
  Random random(12);
  int weak = 0, sound = 0;
  double least = 1;
  constexpr int kPoints = 20000;
  for (int n = 0; n < kPoints; ++n) {
    const double f = g.at(20 * random_point(random)).value;
    EXPECT_LT(f, 1 + 1e-12);
    least = std::min(least, f);
    weak += f < 0.6;
    sound += f > 0.999;
  }
  EXPECT_GT(least, 0.2);  // where three grains meet a little weaker than 0.3
  EXPECT_LT(least, 0.31);
  // A random Voronoi mosaic has 2.91 / size of boundary per volume; weaker than 0.6 within 0.46 widths of it.
  EXPECT_NEAR(weak / double(kPoints), 2 * 0.46 * 0.1 * 2.91, 0.03);
  EXPECT_GT(sound / double(kPoints), 0.35);
}

TEST(Grains, AreAsLargeAsAskedFor) {
  // Boundaries crossed along a line: 2.91 / 2 per size for a random Voronoi mosaic (S_V = 2.91, P_L = S_V/2).
  const Grains g{.size = 0.25, .width = 0.005, .weakening = 0.5, .spread = 0, .seed = 5};
  int crossed = 0;
  constexpr double kLength = 200, kStep = 0.002;
  bool weak = false;
  for (double s = 0; s < kLength; s += kStep) {
    const bool now = g.at(s * Vec3(0.48, 0.6, 0.64)).value < 0.75;
    crossed += now && !weak;
    weak = now;
  }
  EXPECT_NEAR(crossed * 0.25 / kLength, 1.43, 0.12);
}

TEST(Grains, StretchedOnesAreLongerThatWay) {
  const Grains g{.size = 0.25, .stretch = {1, 1, 3}, .width = 0.02, .weakening = 0.5, .spread = 0, .seed = 5};
  double slope_x = 0, slope_z = 0;
  Random random(13);
  for (int n = 0; n < 20000; ++n) {
    const FieldSample f = g.at(20 * random_point(random));
    slope_x += f.gradient[0] * f.gradient[0];
    slope_z += f.gradient[2] * f.gradient[2];
  }
  EXPECT_NEAR(std::sqrt(slope_x / slope_z), 3, 0.3);
}

TEST(Voxels, ConstantsAndRampsAreKept) {
  auto grid = std::make_shared<VoxelGrid>();
  grid->size = {8, 6, 5};
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i)
        grid->values.push_back(static_cast<float>(2 + i + 0.5 * j));
  const Voxels voxels{grid, 0.1, Outside::clamped};
  const FieldSample at = voxels.at(Vec3(0.33, 0.21, 0.2));
  EXPECT_NEAR(at.value, 2 + 3.3 + 1.05, 1e-6);
  EXPECT_LT((at.gradient - Vec3(10, 5, 0)).norm(), 1e-5);
  EXPECT_NEAR(voxels.at(Vec3(1e30, 0.2, 0)).value, 2 + 7 + 1, 1e-6);  // clamped
}

TEST(Voxels, PeriodicOnesRepeat) {
  const Voxels voxels{test::random_grid(), 0.5, Outside::periodic};
  const double period = 0.5 * test::kGridVoxel * 7;
  const Vec3 x(0.11, 0.05, -0.4);
  EXPECT_NEAR(voxels.at(x).value, voxels.at(x + period * Vec3::UnitX()).value, 1e-9);
  EXPECT_NEAR(voxels.at(x).value, voxels.at(x - 3 * period * Vec3::UnitX()).value, 1e-9);
}

}  // namespace
}  // namespace conchoid
