#include "conchoid/learn/regressor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/regressor_file.hpp"

namespace conchoid {
namespace {

bool within(double x, const FeatureRange& range) {
  return within_range(x, range.minimum, range.maximum);
}

void require_finite(const FeatureMatrix& matrix, std::string_view kind) {
  for (const double value : matrix.values)
    if (!std::isfinite(value))
      throw InputError(
          std::string(kind) +
          ": a feature is not a finite number; check the state of the crack it was computed from");
}

}  // namespace

bool within_range(double x, double minimum, double maximum) {
  const double slack = 1e-9 * std::max(std::abs(minimum), std::abs(maximum));
  return x >= minimum - slack && x <= maximum + slack;
}

Prediction Regressor::predict(std::span<const double> row) const {
  return predict(FeatureMatrix{record_.features, row.size(), {row.begin(), row.end()}, {}}).front();
}

std::vector<Prediction> Regressor::predict(const FeatureMatrix& rows) const {
  if (rows.set != record_.features || rows.columns != record_.ranges.size())
    throw InputError("the " + std::string(name()) + " was trained with feature set " +
                     std::string(conchoid::name(record_.features)) + ", the data are of " +
                     std::string(conchoid::name(rows.set)) + " (" + std::to_string(rows.columns) +
                     " features); compute the features of its own set or train another one");
  require_finite(rows, name());
  const std::vector<std::string>& hidden = record_.provenance.hidden_features;
  std::optional<FeatureMatrix> seen;
  if (!hidden.empty()) hide_features(seen.emplace(rows), hidden);
  const FeatureMatrix& matrix = seen ? *seen : rows;
  std::vector<Prediction> result(matrix.rows());
  parallel_for(result.size(), 256, [&](std::size_t begin, std::size_t end) {
    predict_standardised(matrix, begin, end, std::span(result).subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      for (int mode = 0; mode < 3; ++mode) {
        result[i].mean[mode] = record_.label_mean[mode] + record_.label_scale[mode] * result[i].mean[mode];
        result[i].spread[mode] = record_.label_scale[mode] * result[i].spread[mode];
      }
      for (std::size_t c = 0; c < matrix.columns; ++c)
        if (!within(matrix.row(i)[c], record_.ranges[c])) result[i].in_range = false;
    }
  });
  return result;
}

// With the spread as it comes from the kind of regressor.
std::vector<Prediction> Regressor::stated_labels(const SampleSet& samples) const {
  const FeatureSet set = record_.features;
  FeatureMatrix rows = feature_matrix(samples, set);
  const int images = image_count(set);
  if (images == 1) return predict(rows);
  std::vector<Prediction> mean(samples.size());
  for (int image = 0; image < images; ++image) {
    FeatureMatrix of_image = rows;
    for (std::size_t i = 0; i < samples.size(); ++i)
      apply_image(set, image, of_image.row_of(i));
    const std::vector<Prediction> labels = predict(of_image);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      mean[i].mean += label_image(set, image, labels[i].mean) / images;
      mean[i].spread += labels[i].spread / images;
      mean[i].in_range = mean[i].in_range && labels[i].in_range;
    }
  }
  return mean;
}

std::vector<Prediction> Regressor::predict_labels(const SampleSet& samples) const {
  std::vector<Prediction> labels = stated_labels(samples);
  for (Prediction& p : labels)
    for (int mode = 0; mode < 3; ++mode)
      p.spread[mode] = record_.calibration[static_cast<std::size_t>(mode)](p.spread[mode]);
  return labels;
}

void Regressor::calibrate(const SampleSet& unseen) {
  if (unseen.hash() == record_.provenance.samples_hash)
    throw InputError(
        "these are the samples of the training, which tell nothing of its errors; give runs that it has not "
        "seen");
  require_recorded(record_.features, unseen);
  const std::vector<Prediction> predicted = stated_labels(unseen);
  std::array<SpreadCalibration, 3> calibration;
  bool states_some = false;
  for (int mode = 0; mode < 3; ++mode) {
    std::vector<double> stated, errors;
    for (std::size_t i = 0; i < unseen.size(); ++i) {
      stated.push_back(predicted[i].spread[mode]);
      errors.push_back(label(unseen[i], record_.features)[mode] - predicted[i].mean[mode]);
    }
    const auto is_something = [](double x) { return x != 0; };
    if (!std::ranges::any_of(stated, is_something)) continue;
    states_some = true;
    if (std::ranges::any_of(errors, is_something))
      calibration[static_cast<std::size_t>(mode)] = SpreadCalibration::measure(stated, errors);
  }
  if (!states_some)
    throw InputError(
        "the " + std::string(name()) +
        " states no spread that could be calibrated, as it is of one set only; train it on more runs");
  if (calibration == std::array<SpreadCalibration, 3>{})
    throw InputError("the " + std::string(name()) +
                     " makes no error on these samples to calibrate its spread by; give runs that differ");
  record_.calibration = std::move(calibration);
}

std::vector<OpeningPrediction> Regressor::predict_openings(const SampleSet& samples) const {
  const FeatureSet set = record_.features;
  const std::vector<Prediction> labels = predict_labels(samples);
  std::vector<OpeningPrediction> result(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    result[i] = {opening_from_label(s, set, labels[i].mean), opening_spread(s, set, labels[i].spread),
                 labels[i].in_range, driving_from_label(s, set, labels[i].mean),
                 driving_spread(s, set, labels[i].mean, labels[i].spread)};
  }
  return result;
}

std::vector<std::string> Regressor::out_of_range(std::span<const double> row) const {
  const std::vector<std::string> names = feature_names(record_.features);
  std::vector<std::string> result;
  for (std::size_t c = 0; c < std::min(row.size(), record_.ranges.size()); ++c) {
    const FeatureRange& range = record_.ranges[c];
    if (within(row[c], range)) continue;
    std::ostringstream text;
    text << names[c] << " = " << row[c] << " (trained on " << range.minimum << " ... " << range.maximum
         << ")";
    result.push_back(text.str());
  }
  return result;
}

std::string Regressor::file_bytes() const {
  ByteWriter fit;
  write_fit(fit);
  return regressor_bytes(name(), record_, settings_json(), fit.bytes());
}

void Regressor::save(const std::filesystem::path& file) const {
  write_bytes(file, file_bytes());
}

std::uint64_t Regressor::content_hash() const {
  return hash_bytes(file_bytes());
}

}  // namespace conchoid
