#include "conchoid/learn/forest.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::synthetic_runs;
using test::TemporaryFolder;

RegressionForest small_forest(FeatureSet set = FeatureSet::paper_4, int trees = 8, int depth = 6) {
  ForestSettings settings;
  settings.trees = trees;
  settings.depth = depth;
  settings.features = set;
  Provenance p;
  p.models = {"cube"};
  p.material = {3.1e9, 0.327, 1200, 7.6e7, 1e6, 3};
  p.resolution = 0.1;
  p.spec = "model = \"cube\"\n";
  return RegressionForest::train(synthetic_runs(20, 1.1, 0.3), settings, p);
}

/// Share of the variance of the opening that the forest explains, per mode.
Vec3 r_squared(const RegressionForest& forest, const SampleSet& test) {
  const auto predicted = forest.predict_openings(test);
  Vec3 result;
  for (int mode = 0; mode < 3; ++mode) {
    double mean = 0, error = 0, variance = 0;
    for (std::size_t i = 0; i < test.size(); ++i)
      mean += test[i].opening[mode] / static_cast<double>(test.size());
    for (std::size_t i = 0; i < test.size(); ++i) {
      error += std::pow(test[i].opening[mode] - predicted[i].opening[mode], 2);
      variance += std::pow(test[i].opening[mode] - mean, 2);
    }
    result[mode] = 1 - error / variance;
  }
  return result;
}

TEST(Forest, LearnsHowIntensitiesChange) {
  SampleSet train, unseen;
  for (int run = 0; run < 80; ++run)
    train.append(test::synthetic_run(run, 8, 10, 1.15, 0.2));
  for (int run = 500; run < 520; ++run)
    unseen.append(test::synthetic_run(run, 8, 10, 1.15, 0.2));
  ForestSettings settings;
  settings.trees = 25;
  settings.features = FeatureSet::dimensionless;
  const Vec3 learned = r_squared(RegressionForest::train(train, settings), unseen);
  EXPECT_GT(learned[0], 0.995);
  EXPECT_GT(learned[1], 0.99);
  EXPECT_GT(learned[2], 0.995);
  settings.features = FeatureSet::paper_4;
  const Vec3 paper = r_squared(RegressionForest::train(train, settings), unseen);
  EXPECT_GT(paper[0], 0.5) << "the published set does not know the correlation distance";
  EXPECT_GT(learned[0], paper[0]);
}

TEST(Forest, HoldsForAnotherSizeAndMaterialIfDimensionless) {
  const RegressionForest forest = small_forest(FeatureSet::dimensionless, 20, 8);
  SampleSet large = synthetic_runs(3, 1.1, 0.3);
  const SampleSet small = large;
  SampleSet copy;
  for (std::size_t i = 0; i < large.size(); ++i) {
    Sample s = large[i];
    s.K *= 1000 * 8;  // size × 64, stiffness × 1000
    s.toughness *= 1000 * 8;
    s.youngs_modulus *= 1000;
    s.traction *= 1000;
    s.front_curvature /= 64;
    for (double* length :
         {&s.resolution, &s.distance_before, &s.distance_after, &s.travelled, &s.surface_distance})
      *length *= 64;
    copy.add(s);
  }
  const auto a = forest.predict_openings(small), b = forest.predict_openings(copy);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((64 * a[i].opening - b[i].opening).norm(), 1e-3 * b[i].opening.norm());
    EXPECT_EQ(a[i].in_range, b[i].in_range);
  }
}

TEST(Forest, SaysWhenDataLeaveTheTraining) {
  const RegressionForest forest = small_forest();
  const SampleSet samples = synthetic_runs(20, 1.1, 0.3);
  const FeatureMatrix rows = feature_matrix(samples, FeatureSet::paper_4);
  for (const Prediction& p : forest.predict(rows))
    EXPECT_TRUE(p.in_range);
  std::vector<double> row(rows.row(0).begin(), rows.row(0).end());
  row[0] *= 100;
  EXPECT_FALSE(forest.predict(row).in_range);
  ASSERT_EQ(forest.out_of_range(row).size(), 1u);
  EXPECT_NE(forest.out_of_range(row)[0].find("K_I/sqrt(r_bar)"), std::string::npos);
  EXPECT_LE(forest.ranges()[0].minimum, forest.ranges()[0].quantiles.front());
  EXPECT_LE(forest.ranges()[0].quantiles.back(), forest.ranges()[0].maximum);
}

TEST(Forest, RefusesRowsOfAnotherFeatureSet) {
  const RegressionForest forest = small_forest();
  EXPECT_THROW(forest.predict(feature_matrix(synthetic_runs(1, 1, 1), FeatureSet::paper_5)), InputError);
  FeatureMatrix mislabelled = feature_matrix(synthetic_runs(1, 1, 1), FeatureSet::dimensionless);
  EXPECT_THROW(forest.predict(mislabelled), InputError);
  EXPECT_THROW(forest.predict(std::vector<double>(3, 1.0)), InputError);
  EXPECT_THROW(forest.predict(std::vector<double>{1, 2, std::nan(""), 4}), InputError);
}

TEST(Forest, RefusesToLearnFromNothingOrNonsense) {
  EXPECT_THROW(RegressionForest::train({}, {}), InputError);
  SampleSet bad = synthetic_runs(1, 1, 1);
  bad.field(6)[2] = 0;
  EXPECT_THROW(RegressionForest::train(bad, {}), InputError);
}

TEST(Forest, LearnsFromASingleSampleAndFromConstantLabels) {
  const SampleSet one = synthetic_runs(1, 1, 1).subset({0});
  const auto p = RegressionForest::train(one, {}).predict_openings(one);
  EXPECT_LT((p[0].opening - one[0].opening).norm(), 1e-12 * one[0].opening.norm());
  EXPECT_EQ(p[0].spread.norm(), 0);
}

TEST(Forest, TrainingIsReportedTreeByTreeAndCanBeStopped) {
  int calls = 0;
  ForestSettings settings;
  settings.trees = 4;
  RegressionForest::train(synthetic_runs(2, 1, 1), settings, {}, [&](int done, int total) {
    EXPECT_EQ(done, ++calls);
    EXPECT_EQ(total, 12);
  });
  EXPECT_EQ(calls, 12);
  EXPECT_THROW(RegressionForest::train(synthetic_runs(2, 1, 1), settings, {},
                                       [](int, int) { throw Interrupted("stop"); }),
               Interrupted);
}

TEST(ForestFile, BringsTheForestBack) {
  const TemporaryFolder folder;
  const RegressionForest forest = small_forest(FeatureSet::dimensionless_context);
  forest.save(folder / "a.forest");
  const RegressionForest again = RegressionForest::load(folder / "a.forest");
  again.save(folder / "b.forest");
  EXPECT_EQ(read_bytes(folder / "a.forest"), read_bytes(folder / "b.forest"));
  EXPECT_EQ(again.provenance(), forest.provenance());
  EXPECT_EQ(again.ranges(), forest.ranges());
  EXPECT_EQ(again.provenance().runs, 20u);
  const SampleSet samples = synthetic_runs(5, 1.3, 0.5);
  const auto a = forest.predict_openings(samples), b = again.predict_openings(samples);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].opening, b[i].opening);
    EXPECT_EQ(a[i].spread, b[i].spread);
  }
}

TEST(ForestFile, HasTheSameBytesForEveryNumberOfThreads) {
  const TemporaryFolder folder;
  for (const int threads : {1, 2})
    ExecutionContext(threads).run([&] { small_forest().save(folder / std::to_string(threads)); });
  EXPECT_EQ(read_bytes(folder / "1"), read_bytes(folder / "2"));
}

void expect_refused(const std::filesystem::path& file, const std::string& about) {
  try {
    RegressionForest::load(file);
    FAIL() << about << " was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(file.filename().string()), std::string::npos)
        << about << ": " << e.what();
    EXPECT_NE(std::string(e.what()).find("conchoid forest train"), std::string::npos)
        << about << ": " << e.what();
  }
}

TEST(ForestFile, RefusesEveryTruncation) {
  const TemporaryFolder folder;
  small_forest(FeatureSet::paper_3, 2, 3).save(folder / "whole");
  const std::string bytes = read_bytes(folder / "whole");
  for (std::size_t n = 0; n < bytes.size(); n += n < 64 ? 1 : 37) {
    folder.write("part", std::string_view(bytes).substr(0, n));
    expect_refused(folder / "part", std::to_string(n) + " bytes of " + std::to_string(bytes.size()));
  }
}

TEST(ForestFile, RefusesEveryDamagedByte) {
  const TemporaryFolder folder;
  small_forest(FeatureSet::paper_3, 2, 3).save(folder / "whole");
  const std::string bytes = read_bytes(folder / "whole");
  for (std::size_t n = 0; n < bytes.size(); n += n < 64 ? 1 : 29) {
    std::string damaged = bytes;
    damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
    folder.write("damaged", damaged);
    expect_refused(folder / "damaged", "byte " + std::to_string(n));
  }
  write_bytes(folder / "longer", bytes + "x");
  expect_refused(folder / "longer", "an extra byte");
  write_bytes(folder / "foreign", "solid cube\nfacet normal 0 0 1\n");
  expect_refused(folder / "foreign", "an STL file");
}

TEST(ForestFile, RefusesNewerVersionsMissingFilesAndFolders) {
  const TemporaryFolder folder;
  small_forest(FeatureSet::paper_3, 2, 3).save(folder / "whole");
  std::string bytes = read_bytes(folder / "whole");
  bytes[8] = 9;
  write_bytes(folder / "newer", bytes);
  try {
    RegressionForest::load(folder / "newer");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("version 9"), std::string::npos) << e.what();
  }
  EXPECT_THROW(RegressionForest::load(folder / "absent"), InputError);
  EXPECT_THROW(RegressionForest::load(folder.path()), InputError);
  EXPECT_THROW(small_forest(FeatureSet::paper_3, 1, 1).save(folder / "no-folder/forest"), InputError);
}

}  // namespace
}  // namespace conchoid
