#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "conchoid/learn/features.hpp"
#include "conchoid/learn/material_record.hpp"
#include "conchoid/learn/tree_ensemble.hpp"

namespace conchoid {

struct ForestSettings {
  int trees = 50;  ///< t, ≥ 1
  int depth = 10;  ///< d, 1 … 20
  FeatureSet features = FeatureSet::paper_4;
  std::uint64_t seed = 1;  ///< of the bootstrap samples
  int bins = 256;          ///< candidate thresholds per feature, 2 … 65536
};

/// Where the training samples came from.
struct Provenance {
  std::vector<std::string> models;  ///< cube, cylinder, …
  MaterialRecord material;
  double resolution = 0;  ///< r̄ of the runs [m]
  std::size_t runs = 0, samples = 0;
  std::uint64_t samples_hash = 0;  ///< SampleSet::hash of the training samples
  std::string spec;                ///< text of the specification the runs were generated from
  bool operator==(const Provenance&) const = default;
};

/// What the training data of one feature look like.
struct FeatureRange {
  double minimum = 0, maximum = 0;
  std::array<double, 7> quantiles{};  ///< at FeatureRange::levels
  static constexpr std::array<double, 7> levels = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
  bool operator==(const FeatureRange&) const = default;
};

/// Label of one row of features.
struct Prediction {
  Vec3 mean = Vec3::Zero();    ///< modes I, II, III
  Vec3 spread = Vec3::Zero();  ///< standard deviation between the trees
  bool in_range =
      true;  ///< every feature lies between the smallest and the largest of the training, up to round-off
};

/// Predicted opening of one sample.
struct OpeningPrediction {
  Vec3 opening = Vec3::Zero();  ///< Δu [m] in the front frame of frame n−1
  Vec3 spread = Vec3::Zero();   ///< its standard deviation between the trees [m]
  bool in_range = true;
};

/// Three regression forests, one per fracture mode, over one feature set: bagging as in Breiman 1996 (see
/// bagging.hpp). Labels are brought to zero mean and unit deviation before training and back after. Trees
/// compare and hold single-precision numbers, sums are double. Prediction needs nothing but this object, is
/// linear in the number of rows, and gives the same bits for every number of threads and every grouping of
/// the rows.
class RegressionForest {
 public:
  using Progress = std::function<void(int done, int total)>;

  /// Throws InputError if there are no samples, a sample is not valid or a setting is out of its range. The
  /// numbers of runs and samples and the hash in the provenance are filled in here.
  /// @param progress  called after every tree; may throw (Interrupted) to stop
  static RegressionForest train(const SampleSet& samples, const ForestSettings& settings,
                                Provenance provenance = {}, const Progress& progress = {});
  /// Throws InputError that names the file and the remedy if it is truncated, corrupt, foreign or of a newer
  /// version.
  static RegressionForest load(const std::filesystem::path& file);
  /// One portable file; appears complete or not at all. The same forest gives the same bytes.
  void save(const std::filesystem::path& file) const;

  /// @param row  features of the forest's own set, finite
  Prediction predict(std::span<const double> row) const;
  /// Throws InputError if the rows are of another feature set or not finite.
  std::vector<Prediction> predict(const FeatureMatrix& rows) const;
  /// Features, prediction and label scaling in one step.
  std::vector<OpeningPrediction> predict_openings(const SampleSet& samples) const;

  const ForestSettings& settings() const { return settings_; }
  const Provenance& provenance() const { return provenance_; }
  const std::vector<FeatureRange>& ranges() const { return ranges_; }
  const TreeEnsemble& ensemble(int mode) const { return ensembles_[static_cast<std::size_t>(mode)]; }
  /// Names of the features of row that lie outside the range of the training, with value and range: for a
  /// warning.
  std::vector<std::string> out_of_range(std::span<const double> row) const;

 private:
  ForestSettings settings_;
  Provenance provenance_;
  std::vector<FeatureRange> ranges_;
  Vec3 label_mean_ = Vec3::Zero(), label_scale_ = Vec3::Ones();
  std::array<TreeEnsemble, 3> ensembles_;
};

}  // namespace conchoid
