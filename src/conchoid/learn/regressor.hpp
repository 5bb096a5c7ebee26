#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/core/bytes.hpp"
#include "conchoid/learn/features.hpp"
#include "conchoid/learn/material_record.hpp"
#include "conchoid/learn/opening_predictor.hpp"
#include "conchoid/learn/spread_calibration.hpp"

namespace conchoid {

class TreeEnsemble;

/// Where the training samples came from.
struct Provenance {
  std::vector<std::string> models;  ///< cube, cylinder, …
  MaterialRecord material;
  double resolution = 0;  ///< r̄ of the runs [m]
  std::size_t runs = 0, samples = 0;
  std::uint64_t samples_hash = 0;  ///< SampleSet::hash of the training samples
  std::string spec;                ///< text of the specification the runs were generated from
  /// Names of features that it was not to look at: zero in training, and whenever it is asked.
  std::vector<std::string> hidden_features = {};
  bool operator==(const Provenance&) const = default;
};

/// What the training data of one feature look like.
struct FeatureRange {
  double minimum = 0, maximum = 0;
  std::array<double, 7> quantiles{};  ///< at FeatureRange::levels
  static constexpr std::array<double, 7> levels = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
  bool operator==(const FeatureRange&) const = default;
};

/// Whether a feature lies within a range of the training; a physically scaled copy differs by round-off and
/// still does.
bool within_range(double x, double minimum, double maximum);

/// What every regressor keeps of its training.
struct TrainingRecord {
  FeatureSet features = FeatureSet::paper_4;
  Provenance provenance;
  std::vector<FeatureRange> ranges;  ///< per feature
  /// Labels are brought to zero mean and unit deviation before training, and back after.
  Vec3 label_mean = Vec3::Zero(), label_scale = Vec3::Ones();
  /// Of the spread of labels, by runs that are not of the training.
  std::array<SpreadCalibration, 3> calibration;
  bool calibrated() const { return calibration != std::array<SpreadCalibration, 3>{}; }
};

/// Label of one row of features.
struct Prediction {
  Vec3 mean = Vec3::Zero();    ///< modes I, II, III
  Vec3 spread = Vec3::Zero();  ///< standard deviation that the regressor gives its answer
  /// Every feature lies between the smallest and the largest of the training, up to round-off.
  bool in_range = true;
};

/// Called during training; may throw (Interrupted) to stop it.
using TrainingProgress = std::function<void(int done, int total)>;

/// A rule learned from samples: features of the frame before → label, modes I, II, III (features.hpp).
///
/// This class computes features, brings labels back to openings and compares with the ranges of the training;
/// a kind of regressor adds the map from features to standardised labels, and its bytes. Kinds are listed in
/// regressor_kinds.hpp. Prediction is linear in the number of rows, and gives the same bits for every number
/// of threads and every grouping of the rows.
class Regressor : public OpeningPredictor {
 public:
  /// Name in the list of kinds: "forest", "ridge".
  std::string_view name() const override = 0;

  bool looks_around() const override { return !context_fields(record_.features).empty(); }
  std::vector<OpeningPrediction> predict_openings(const SampleSet& samples) const override;
  /// Labels of samples: the mean over the images that the feature set has; the spread as calibrated.
  std::vector<Prediction> predict_labels(const SampleSet& samples) const;
  /// Replaces the calibration of the spread by one from samples of runs that the training has not seen. Throws InputError if
  /// they are too few (SpreadCalibration::measure), or the very samples of the training, or if it states no spread; a mode
  /// without spread or without errors is left as it is.
  void calibrate(const SampleSet& unseen);
  bool calibrated() const override { return record_.calibrated(); }
  /// Throws InputError if the rows are of another feature set or not finite.
  std::vector<Prediction> predict(const FeatureMatrix& rows) const;
  /// @param row  features of the regressor's own set, finite
  Prediction predict(std::span<const double> row) const;

  FeatureSet feature_set() const { return record_.features; }
  const Provenance& provenance() const { return record_.provenance; }
  const std::vector<FeatureRange>& ranges() const { return record_.ranges; }
  const TrainingRecord& record() const { return record_; }
  /// Names of the features of row that lie outside the range of the training, with value and range: for a
  /// warning.
  std::vector<std::string> out_of_range(std::span<const double> row) const;

  /// Settings of the training that belong to this kind alone: the text of a JSON object. Part of the file.
  virtual std::string settings_json() const = 0;
  /// The trees it has for a mode, if it has any.
  virtual std::vector<const TreeEnsemble*> ensembles(int /*mode*/) const { return {}; }
  /// What else there is to tell about the fitted rule (sizes): the text of a JSON object.
  virtual std::string fit_json() const = 0;
  /// The same for a person, in a line: "trees       50 of depth 10 per mode".
  virtual std::string summary() const = 0;

  /// One portable file; appears complete or not at all. The same regressor gives the same bytes.
  void save(const std::filesystem::path& file) const;
  /// Hash of everything in the file: regressors that differ in anything have different ones.
  std::uint64_t content_hash() const;

 protected:
  Regressor() = default;
  explicit Regressor(TrainingRecord record) : record_(std::move(record)) {}

  /// Mean and spread of the standardised labels for rows begin … end of the matrix; rows are finite.
  virtual void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                                    std::span<Prediction> out) const = 0;
  /// The fitted numbers, as the kind's own reader takes them back.
  virtual void write_fit(ByteWriter& out) const = 0;

 private:
  std::string file_bytes() const;
  std::vector<Prediction> stated_labels(const SampleSet& samples) const;
  TrainingRecord record_;
};

/// Reads a regressor of whatever kind: the first bytes of the file say which. Throws InputError that names
/// the file and the remedy if it is truncated, corrupt, foreign or of a newer version.
std::unique_ptr<Regressor> load_regressor(const std::filesystem::path& file);

}  // namespace conchoid
