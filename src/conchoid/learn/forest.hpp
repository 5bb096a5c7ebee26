#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "conchoid/learn/regressor.hpp"
#include "conchoid/learn/tree_ensemble.hpp"

namespace conchoid {

struct RegressorKind;

struct ForestSettings {
  int trees = 50;  ///< t, ≥ 1
  int depth = 10;  ///< d, 1 … 20
  FeatureSet features = FeatureSet::paper_4;
  std::uint64_t seed = 1;  ///< of the bootstrap samples
  int bins = 256;          ///< candidate thresholds per feature, 2 … 65536
  int leaf = 1;            ///< least number of samples in a leaf, ≥ 1
};

/// Three regression forests, one per fracture mode, over one feature set: bagging as in Breiman 1996 (see
/// bagging.hpp). Trees compare and hold single-precision numbers, sums are double. The spread is the standard
/// deviation between the trees.
class RegressionForest : public Regressor {
 public:
  using Progress = TrainingProgress;

  /// Throws InputError if there are no samples, a sample is not valid, the feature set looks at quantities
  /// that nobody recorded, or a setting is out of its range. The numbers of runs and samples and the hash in
  /// the provenance are filled in here.
  /// @param progress  called after every tree; may throw (Interrupted) to stop
  static RegressionForest train(const SampleSet& samples, const ForestSettings& settings,
                                Provenance provenance = {}, const Progress& progress = {});
  /// As load_regressor; throws InputError too if the file holds another kind of regressor.
  static RegressionForest load(const std::filesystem::path& file);
  /// What write_fit wrote, back (RegressorKind::read).
  static std::unique_ptr<Regressor> read(TrainingRecord record, const std::string& settings, ByteReader& fit);

  std::string_view name() const override { return "forest"; }
  std::string settings_json() const override;
  std::string fit_json() const override;
  std::string summary() const override;
  std::vector<const TreeEnsemble*> ensembles(int mode) const override { return {&ensemble(mode)}; }

  const ForestSettings& settings() const { return settings_; }
  const TreeEnsemble& ensemble(int mode) const { return ensembles_[static_cast<std::size_t>(mode)]; }

 protected:
  void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                            std::span<Prediction> out) const override;
  void write_fit(ByteWriter& out) const override;

 private:
  RegressionForest(TrainingRecord record, const ForestSettings& settings)
      : Regressor(std::move(record)), settings_(settings) {}

  ForestSettings settings_;
  std::array<TreeEnsemble, 3> ensembles_;
};

/// The entry in the list of kinds.
RegressorKind forest_kind();

}  // namespace conchoid
