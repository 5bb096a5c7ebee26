#include "conchoid/learn/regressor_kinds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "conchoid/core/bytes.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/summary.hpp"
#include "refusal.hpp"
#include "synthetic.hpp"

// What holds for every kind of regressor.
namespace conchoid {
namespace {

using test::refusal;
using test::synthetic_runs;
using test::TemporaryFolder;

/// As quickly trained as may be.
TrainingSettings quick(const RegressorKind& kind, FeatureSet set = FeatureSet::dimensionless) {
  TrainingSettings settings;
  settings.features = set;
  if (kind.name == "forest" || kind.name == "boosted") settings.options = {{"trees", 3}, {"depth", 4}};
  if (kind.name == "network") settings.options = {{"width", 4}, {"epochs", 2}};
  return settings;
}

std::unique_ptr<Regressor> trained(const RegressorKind& kind, FeatureSet set = FeatureSet::dimensionless) {
  return train_regressor(kind, synthetic_runs(10, 1.1, 0.5), quick(kind, set));
}

void expect_part(const std::string& text, const std::string& part, const std::string& about) {
  EXPECT_NE(text.find(part), std::string::npos) << about << ": " << text;
}

TEST(RegressorKinds, AreKnownByNameAndMagic) {
  std::set<std::string_view> names, magics;
  for (const RegressorKind& kind : regressor_kinds()) {
    names.insert(kind.name);
    magics.insert(kind.magic);
    EXPECT_EQ(kind.magic.size(), 8u);
    EXPECT_EQ(&regressor_kind(kind.name), &kind);
  }
  EXPECT_EQ(names.size(), regressor_kinds().size());
  EXPECT_EQ(magics.size(), regressor_kinds().size());
  EXPECT_TRUE(names.contains("forest"));
  expect_part(refusal([] { regressor_kind("oracle"); }), regressor_names(), "oracle");
}

TEST(RegressorKinds, TheFileSaysWhichItIs) {
  const TemporaryFolder folder;
  for (const RegressorKind& kind : regressor_kinds()) {
    const std::string name(kind.name);
    const auto regressor = trained(kind);
    EXPECT_EQ(regressor->name(), kind.name);
    regressor->save(folder / name);
    const auto again = load_regressor(folder / name);
    EXPECT_EQ(again->name(), kind.name);
    EXPECT_EQ(again->feature_set(), FeatureSet::dimensionless);
    EXPECT_EQ(again->provenance(), regressor->provenance());
    EXPECT_EQ(again->ranges(), regressor->ranges());
    EXPECT_EQ(again->content_hash(), regressor->content_hash());
    again->save(folder / (name + "-2"));
    EXPECT_EQ(read_bytes(folder / name), read_bytes(folder / (name + "-2")));
    if (kind.name != "forest")
      expect_part(refusal([&] { RegressionForest::load(folder / name); }), std::string(kind.title), name);
  }
}

// Whatever is learned: other values of what is hidden give the same answer, bit for bit, also after the file was read.
TEST(RegressorKinds, HiddenFeaturesAreNotLookedAt) {
  const TemporaryFolder folder;
  const SampleSet samples = synthetic_runs(10, 1.1, 0.5);
  FeatureMatrix rows = feature_matrix(samples, FeatureSet::dimensionless);
  FeatureMatrix others = rows;
  for (std::size_t i = 0; i < rows.rows(); ++i)
    others.row_of(i)[0] += 3 + static_cast<double>(i);  // K_I/S
  for (const RegressorKind& kind : regressor_kinds()) {
    const auto seeing = trained(kind);
    Provenance provenance;
    provenance.hidden_features = {"K_I/S"};
    const auto blind = train_regressor(kind, samples, quick(kind, FeatureSet::dimensionless), provenance);
    blind->save(folder / "blind");
    const auto again = load_regressor(folder / "blind");
    EXPECT_EQ(again->provenance().hidden_features, provenance.hidden_features);
    bool differs = false;
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      const Prediction one = blind->predict(rows.row(i)), other = again->predict(others.row(i));
      EXPECT_EQ(one.mean, other.mean) << kind.name;
      EXPECT_EQ(one.in_range, other.in_range) << kind.name;
      differs |= one.mean != seeing->predict(rows.row(i)).mean;
    }
    EXPECT_TRUE(differs) << kind.name << ": K_I/S tells nothing here, so hiding it tests nothing";
  }
}

void expect_refused(const std::filesystem::path& file, const std::string& about) {
  const std::string text = refusal([&] { load_regressor(file); });
  expect_part(text, file.filename().string(), about);
  expect_part(text, "conchoid forest train", about);
}

TEST(RegressorKinds, DamagedFilesAreRefused) {
  const TemporaryFolder folder;
  for (const RegressorKind& kind : regressor_kinds()) {
    trained(kind, FeatureSet::paper_3)->save(folder / "whole");
    const std::string bytes = read_bytes(folder / "whole");
    for (std::size_t n = 0; n < bytes.size(); n += n < 64 ? 1 : 37) {
      folder.write("part", std::string_view(bytes).substr(0, n));
      expect_refused(folder / "part", std::string(kind.name) + ", bytes " + std::to_string(n));
      std::string damaged = bytes;
      damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
      folder.write("damaged", damaged);
      expect_refused(folder / "damaged", std::string(kind.name) + ", byte " + std::to_string(n));
    }
    folder.write("longer", bytes + "x");
    expect_refused(folder / "longer", "an extra byte");
    std::string newer = bytes;
    newer[8] = 9;
    folder.write("newer", newer);
    expect_part(refusal([&] { load_regressor(folder / "newer"); }), "version 9", std::string(kind.name));
  }
  folder.write("foreign", "solid cube\n");
  expect_part(refusal([&] { load_regressor(folder / "foreign"); }), regressor_names(), "foreign");
}

// A checksum that is right does not make the content right.
TEST(RegressorKinds, TheContentIsLookedAtToo) {
  const TemporaryFolder folder;
  for (const RegressorKind& kind : regressor_kinds()) {
    trained(kind, FeatureSet::paper_3)->save(folder / "whole");
    std::string bytes = read_bytes(folder / "whole");
    bytes.resize(bytes.size() - 8 - 4);  // without the checksum and the last bytes of the fit
    ByteWriter length;
    length.put(static_cast<std::uint64_t>(bytes.size() - 24));
    bytes.replace(16, 8, length.bytes());
    ByteWriter checksum;
    checksum.put(hash_bytes(bytes));
    folder.write("shorter", bytes + checksum.bytes());
    expect_refused(folder / "shorter", std::string(kind.name));
    expect_part(refusal([&] { load_regressor(folder / "shorter"); }), std::string(kind.title), "its kind");
  }
}

TEST(RegressorKinds, OptionsOfAnotherKindAreRefused) {
  const SampleSet samples = synthetic_runs(2, 1, 1);
  for (const RegressorKind& kind : regressor_kinds()) {
    TrainingSettings settings;
    settings.options["sails"] = 3;
    const std::string text = refusal([&] { train_regressor(kind, samples, settings); });
    expect_part(text, "--sails", std::string(kind.name));
    for (const TrainingOption& option : kind.options) {
      expect_part(text, "--" + std::string(option.name), "what there is");
      for (const double value : {option.minimum - 1, option.maximum * 2, std::nan("")}) {
        TrainingSettings wrong = quick(kind);
        wrong.options[std::string(option.name)] = value;
        expect_part(refusal([&] { train_regressor(kind, samples, wrong); }), "--" + std::string(option.name),
                    std::to_string(value));
      }
    }
  }
}

// Same samples, another fit: another hash.
TEST(RegressorKinds, TheHashIsThatOfTheContent) {
  const SampleSet samples = synthetic_runs(3, 1, 1);
  const auto forest = [&](int depth) {
    return RegressionForest::train(samples, {.trees = 2, .depth = depth}).content_hash();
  };
  EXPECT_NE(forest(3), forest(4));
  EXPECT_EQ(forest(3), forest(3));
}

TEST(RegressorKinds, AllAreEvaluatedAlike) {
  const Split split = split_by_run(synthetic_runs(30, 1.3, -0.5), 0.25, 1);
  for (const RegressorKind& kind : regressor_kinds()) {
    TrainingSettings settings;
    settings.features = FeatureSet::dimensionless;
    const auto regressor = train_regressor(kind, split.training, settings);
    const Evaluation e = evaluate(*regressor, split.held_out);
    EXPECT_EQ(e.model.name, kind.name);
    ASSERT_EQ(e.baselines.size(), 1u);
    EXPECT_EQ(e.baselines[0].name, "steady");
    EXPECT_EQ(e.baselines[0].in_range, e.samples);
    EXPECT_TRUE(e.baselines[0].spread.isZero(0));
    EXPECT_GT(e.model.spread[0], 0);
    for (int mode = 0; mode < 2; ++mode)
      EXPECT_GT(e.model.accuracy.r2[mode], std::max(0.95, e.baselines[0].accuracy.r2[mode]))
          << kind.name << mode;
    const std::string json = json_text(e), about = json_text(*regressor);
    for (const char* key : {"\"samples\"", "\"rmse\"", "\"r2\"", "\"baseline_steady\"", "\"III\""})
      expect_part(json, key, std::string(kind.name));
    for (const char* key : {"\"feature_set\"", "\"content_hash\"", "\"samples_hash\"", "\"quantiles\""})
      expect_part(about, key, std::string(kind.name));
  }
}

TEST(RegressorKinds, FieldsThatNobodyRecordedAreRefused) {
  SampleSet samples = synthetic_runs(3, 1, 1);
  for (const std::size_t f : {10u, 12u, 13u, 14u})
    std::fill(samples.field(f).begin(), samples.field(f).end(), 0.0);
  for (const RegressorKind& kind : regressor_kinds()) {
    const auto train = [&] {
      train_regressor(kind, samples, quick(kind, FeatureSet::dimensionless_context));
    };
    const std::string text = refusal(train);
    for (const char* field : {"front_curvature", "traction_I", "traction_III"})
      expect_part(text, field, std::string(kind.name));
    EXPECT_EQ(text.find("surface_distance"), std::string::npos) << "this one is there";
    const auto context = trained(kind, FeatureSet::dimensionless_context);
    EXPECT_EQ(refusal([&] { evaluate(*context, samples); }), text) << "neither learned from nor evaluated on";
  }
}

}  // namespace
}  // namespace conchoid
