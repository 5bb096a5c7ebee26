#include "conchoid/learn/versatile_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "conchoid/core/bytes.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/learn/forest.hpp"
#include "refusal.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

constexpr FeatureSet kSet = FeatureSet::versatile;

Vec3 random_vector(std::mt19937_64& random) {
  return {test::uniform(random) - 0.5, test::uniform(random) - 0.5, test::uniform(random) - 0.5};
}

/// Everything is filled in; K_I > 0, before and after.
Sample random_sample(int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 7);
  Sample s = test::synthetic_run(seed, 2, 1, 1.1, 0.3)[0];
  s.lateral = 1e6 * random_vector(random);
  s.wall_distance = 0.2;
  for (Vec3* K : {&s.driving, &s.driving_nearby, &s.driving_front, &s.driving_after})
    *K = 1e7 * (Vec3(1, 0, 0) + 0.5 * random_vector(random));
  s.driving_slope = 1e6 * random_vector(random);
  s.crack_radius = 0.3;
  s.ligament_share = 0.4;
  s.front_curvature_after = 1.5;
  s.surface_distance_after = 0.3;
  s.wall_distance_after = 0.1;
  s.traction_after = 3e6 * (Vec3(1, 0, 0) + random_vector(random));
  s.lateral_after = 1e6 * random_vector(random);
  s.taken_over = 2e6 * (Vec3(1, 0, 0) + random_vector(random));
  s.taken_over_after = 2e6 * (Vec3(1, 0, 0) + random_vector(random));
  s.crack_force = 1e5 * (Vec3(1, 0, 0) + random_vector(random));
  s.crack_moment = 1e4 * random_vector(random);
  s.arms = 3e6;
  s.arms_after = 4e6;
  s.beside = {0.4, 0.2, 0.5, 0.7, 0.3, 0.35, 0.9, 0.8};
  s.turn = 0.2 * random_vector(random);
  return s;
}

std::vector<double> row_of(const Sample& s) {
  std::vector<double> row(feature_count(kSet));
  features(s, kSet, row);
  return row;
}

/// The crack normal reversed: e1 and e3 change sign, and which face is which.
Sample reversed(Sample s) {
  for (Vec3* K :
       {&s.K, &s.driving, &s.driving_nearby, &s.driving_front, &s.driving_after, &s.traction,
        &s.traction_after, &s.taken_over, &s.taken_over_after, &s.crack_force, &s.crack_moment, &s.opening})
    (*K)[1] *= -1;
  for (const std::size_t k : {0, 2, 4, 6})
    std::swap(s.beside[k], s.beside[k + 1]);
  s.driving_slope[0] *= -1;
  s.driving_slope[2] *= -1;
  s.lateral[2] *= -1;
  s.lateral_after[2] *= -1;
  s.turn[0] *= -1;
  s.turn[2] *= -1;
  return s;
}

/// The body mirrored across the plane of e1 and e2: what points along e3 changes sign.
Sample mirrored(Sample s) {
  for (Vec3* K : {&s.K, &s.driving, &s.driving_nearby, &s.driving_front, &s.driving_after, &s.traction,
                  &s.traction_after, &s.taken_over, &s.taken_over_after, &s.crack_force, &s.opening})
    (*K)[2] *= -1;
  s.crack_moment[0] *= -1;
  s.crack_moment[1] *= -1;
  std::swap(s.beside[6], s.beside[7]);
  s.driving_slope[0] *= -1;
  s.driving_slope[1] *= -1;
  s.lateral[2] *= -1;
  s.lateral_after[2] *= -1;
  s.turn[1] *= -1;
  s.turn[2] *= -1;
  return s;
}

TEST(VersatileFeatures, SizeUnitLoadAndToughnessDoNotCount) {
  const Sample a = random_sample(1);
  Sample b = a;
  const double s = 30, load = 7, k = 1e3;  // size, load, stiffness; each on its own
  for (double* length :
       {&b.resolution, &b.distance_before, &b.distance_after, &b.travelled, &b.surface_distance,
        &b.wall_distance, &b.crack_radius, &b.surface_distance_after, &b.wall_distance_after})
    *length *= s;
  for (double& length : b.beside)
    length *= s;
  for (double* curvature : {&b.front_curvature, &b.front_curvature_after})
    *curvature /= s;
  for (Vec3* K : {&b.K, &b.driving, &b.driving_nearby, &b.driving_front, &b.driving_after})
    *K *= load * std::sqrt(s);
  b.driving_slope *= load / std::sqrt(s);
  for (Vec3* stress :
       {&b.traction, &b.traction_after, &b.lateral, &b.lateral_after, &b.taken_over, &b.taken_over_after})
    *stress *= load;
  b.crack_force *= load * s * s;
  b.crack_moment *= load * s * s * s;
  for (double* K : {&b.arms, &b.arms_after})
    *K *= load * std::sqrt(s);
  b.youngs_modulus *= k;
  b.toughness *= 0.01;
  const auto row_a = row_of(a), row_b = row_of(b);
  for (std::size_t i = 0; i < row_a.size(); ++i)
    EXPECT_NEAR(row_a[i], row_b[i], 1e-12 * (1 + std::abs(row_a[i]))) << feature_names(kSet)[i];
  EXPECT_NEAR((label(a, kSet) - label(b, kSet)).norm(), 0, 1e-12);
}

TEST(VersatileFeatures, ImagesAreWhatReversedAndMirroredBodiesLookLike) {
  for (int seed = 0; seed < 20; ++seed) {
    const Sample s = random_sample(seed);
    const std::array<Sample, 4> bodies = {s, reversed(s), mirrored(s), reversed(mirrored(s))};
    for (int image = 0; image < 4; ++image) {
      std::vector<double> row = row_of(s);
      apply_image(kSet, image, row);
      const auto seen = row_of(bodies[static_cast<std::size_t>(image)]);
      for (std::size_t i = 0; i < row.size(); ++i)
        EXPECT_NEAR(row[i], seen[i], 1e-15) << image << feature_names(kSet)[i];
      EXPECT_NEAR(
          (label_image(kSet, image, label(s, kSet)) - label(bodies[static_cast<std::size_t>(image)], kSet))
              .norm(),
          0, 1e-14);
    }
  }
}

TEST(VersatileFeatures, TheLabelGivesBackWhatDrives) {
  for (int seed = 0; seed < 20; ++seed) {
    const Sample s = random_sample(seed);
    const Vec3 K = driving_from_label(s, kSet, label(s, kSet)).value();
    EXPECT_NEAR((K - s.driving_after).norm(), 0, 1e-8 * K.norm());
  }
}

// K_III of a crack that is torn is most of what drives it, for some frames; so is K_II of one that slides.
TEST(VersatileFeatures, TearAndShearAreLearnedWhole) {
  Sample s = random_sample(5);
  const Vec3 cases[] = {{4e6, 1e6, 4.5e6}, {0, 0, 4e6}, {4e6, 9e6, 1e6}, {0, -9e6, 1e6}, {0, 9e6, 0}};
  for (const Vec3& K : cases) {
    s.driving_after = K;
    EXPECT_NEAR((driving_from_label(s, kSet, label(s, kSet)).value() - K).norm(), 0, 1e-2) << K.transpose();
  }
}

// K_II is learned as the turn that it makes, at most arccos(1/3): where a crack is closed its size scatters.
TEST(VersatileFeatures, ShearIsLearnedAsHalfTheTurn) {
  for (int seed = 0; seed < 20; ++seed) {
    Sample s = random_sample(seed);
    EXPECT_EQ(label(s, kSet)[1], -kink_angle(s.driving_after, {s.youngs_modulus, s.poisson_ratio}) / 2);
    s.driving_after = {4e6, 1e4, 0};
    EXPECT_NEAR(label(s, kSet)[1], 2.5e-3, 1e-6);
    // Beyond the most that any K turns there is nothing: pure sliding.
    const Vec3 beyond = driving_from_label(s, kSet, Vec3(0, -1, 0)).value();
    EXPECT_NEAR(kink_angle(beyond, {s.youngs_modulus, s.poisson_ratio}), std::acos(1.0 / 3), 1e-6);
  }
}

TEST(VersatileFeatures, NothingLearnedIsStraightOnWithAllOfK) {
  const Sample s = random_sample(3);
  const double nu = s.poisson_ratio;
  const Vec3& K = s.driving;
  const double size = std::sqrt(K[0] * K[0] + K[1] * K[1] + K[2] * K[2] / (1 - nu));
  EXPECT_NEAR((driving_from_label(s, kSet, Vec3::Zero()).value() - Vec3(size, 0, 0)).norm(), 0, 1e-8 * size);
}

TEST(VersatileFeatures, OpeningsAreGivenInTheFrameBefore) {
  Sample s = random_sample(4);
  s.turn = {std::sin(0.3), 0, 0};  // turned by 0.3 towards e1, about e3
  const Vec3 straight = [&] {
    Sample t = s;
    t.turn = Vec3::Zero();
    return versatile_opening(t, {1e7, 0, 0});
  }();
  const Vec3 turned = versatile_opening(s, {1e7, 0, 0});
  EXPECT_NEAR(straight[1], 0, 1e-15);
  EXPECT_NEAR(turned[0], std::cos(0.3) * straight[0], 1e-12 * straight[0]);
  EXPECT_NEAR(turned[1], -std::sin(0.3) * straight[0], 1e-12 * straight[0]);
}

SampleSet random_samples(int count) {
  SampleSet samples;
  for (int i = 0; i < count; ++i)
    samples.add(random_sample(i));
  return samples;
}

TEST(VersatileFeatures, AForestsAnswersHaveTheSymmetriesExactly) {
  const RegressionForest forest = RegressionForest::train(random_samples(120), {5, 8, kSet, 1, 256});
  for (int seed = 200; seed < 220; ++seed) {
    const Sample s = random_sample(seed);
    SampleSet bodies;
    for (const Sample& body : {s, reversed(s), mirrored(s)})
      bodies.add(body);
    const auto labels = forest.predict_labels(bodies);
    const Vec3 plain = labels[0].mean;
    EXPECT_NEAR((labels[1].mean - Vec3(plain[0], -plain[1], plain[2])).norm(), 0, 1e-14);
    EXPECT_NEAR((labels[2].mean - Vec3(plain[0], plain[1], -plain[2])).norm(), 0, 1e-14);
  }
}

TEST(VersatileFeatures, PureModeOneGoesStraightOn) {
  const RegressionForest forest = RegressionForest::train(random_samples(120), {5, 8, kSet, 1, 256});
  Sample s = random_sample(300);
  for (Vec3* K : {&s.driving, &s.driving_nearby, &s.driving_front, &s.traction, &s.traction_after,
                  &s.taken_over, &s.taken_over_after, &s.crack_force})
    *K = {(*K)[0], 0, 0};
  s.crack_moment[0] = 0;
  for (const std::size_t k : {0, 2, 4})
    s.beside[k] = s.beside[k + 1];
  s.driving_slope = s.turn = Vec3::Zero();
  s.lateral[2] = s.lateral_after[2] = 0;
  SampleSet one;
  one.add(s);
  const OpeningPrediction p = forest.predict_openings(one).front();
  ASSERT_TRUE(p.driving.has_value());
  EXPECT_EQ((*p.driving)[1], 0);
  EXPECT_EQ((*p.driving)[2], 0);
  EXPECT_GT((*p.driving)[0], 0);
}

// K at the size that it has: slope of K_II over the turn, linear in w_III.
TEST(VersatileFeatures, SpreadOfKIsThatOfItsDirection) {
  for (int seed = 0; seed < 10; ++seed) {
    const Sample s = random_sample(seed);
    const Vec3 at(0.3, 0.1, -0.2), more(0.5, 1e-4, 1e-4);
    const Vec3 spread = versatile_driving_spread(s, at, more);
    const Vec3 step(0, more[1], more[2]);
    const Vec3 half = (versatile_driving(s, at + step) - versatile_driving(s, at - step)) / 2;
    EXPECT_EQ(spread[0], 0);
    for (const int mode : {1, 2})
      EXPECT_NEAR(spread[mode], half[mode], 1e-7 * std::abs(half[mode])) << mode;
  }
}

// What was trained to predict something else must not be read as if it were this.
TEST(VersatileFeatures, FilesOfOtherLabelsAreRefused) {
  const test::TemporaryFolder folder;
  const auto checked = [](std::string bytes) {
    ByteWriter checksum;
    checksum.put(hash_bytes(bytes));
    return bytes + checksum.bytes();
  };
  const auto reading = [&](const char* file) {
    return test::refusal([&] { load_regressor(folder / file); });
  };
  for (const FeatureSet set : {FeatureSet::paper_3, kSet}) {
    RegressionForest::train(random_samples(40), {2, 4, set, 1, 256}).save(folder / "whole");
    std::string bytes = read_bytes(folder / "whole");
    bytes.resize(bytes.size() - 8);
    const std::string first = nlohmann::json(label_names(set)).dump(), key = "\"label_names\"";
    ASSERT_NE(bytes.find(first), std::string::npos);
    std::string others = bytes;
    others.replace(bytes.find(first) + 2, 1, "x");
    folder.write("others", checked(others));
    EXPECT_NE(reading("others").find("predicts has changed"), std::string::npos) << name(set);
    std::string silent = bytes;  // as it was before files told
    silent.replace(bytes.find(key), key.size(), "\"label_nameZ\"");
    folder.write("silent", checked(silent));
    EXPECT_EQ(reading("silent") == "accepted", set == FeatureSet::paper_3);
  }
}

}  // namespace
}  // namespace conchoid
