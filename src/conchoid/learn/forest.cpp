#include "conchoid/learn/forest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/bagging.hpp"

namespace conchoid {
namespace {

/// To single precision without leaving its range.
float single(double value) {
  constexpr double limit = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -limit, limit));
}

std::vector<float> single_rows(std::span<const double> values) {
  std::vector<float> rows(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      throw InputError(
          "forest: a feature is not a finite number; check the state of the crack it was computed from");
    rows[i] = single(values[i]);
  }
  return rows;
}

std::vector<FeatureRange> measure_ranges(const FeatureMatrix& matrix) {
  std::vector<FeatureRange> ranges(matrix.columns);
  std::vector<double> column(matrix.rows());
  for (std::size_t c = 0; c < matrix.columns; ++c) {
    for (std::size_t i = 0; i < column.size(); ++i)
      column[i] = matrix.values[i * matrix.columns + c];
    std::sort(column.begin(), column.end());
    ranges[c].minimum = column.front();
    ranges[c].maximum = column.back();
    for (std::size_t q = 0; q < FeatureRange::levels.size(); ++q)
      ranges[c].quantiles[q] =
          column[static_cast<std::size_t>(FeatureRange::levels[q] * static_cast<double>(column.size() - 1))];
  }
  return ranges;
}

/// Whether a feature lies within the range of the training; a physically scaled copy differs by round-off and
/// still does.
bool within(double x, const FeatureRange& range) {
  const double slack = 1e-9 * std::max(std::abs(range.minimum), std::abs(range.maximum));
  return x >= range.minimum - slack && x <= range.maximum + slack;
}

struct Moments {
  double mean = 0, deviation = 1;
};

Moments moments(const std::vector<double>& values) {
  double sum = 0, square = 0;
  for (const double v : values)
    sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values)
    square += (v - mean) * (v - mean);
  const double deviation = std::sqrt(square / static_cast<double>(values.size()));
  return {mean, deviation > 0 && std::isfinite(deviation) ? deviation : 1.0};
}

}  // namespace

RegressionForest RegressionForest::train(const SampleSet& samples, const ForestSettings& settings,
                                         Provenance provenance, const Progress& progress) {
  samples.validate();
  if (samples.empty())
    throw InputError("there are no samples to learn from; generate a database with runs that crack");
  RegressionForest forest;
  forest.settings_ = settings;
  forest.provenance_ = std::move(provenance);
  forest.provenance_.samples = samples.size();
  forest.provenance_.runs = std::set<std::int32_t>(samples.run().begin(), samples.run().end()).size();
  forest.provenance_.samples_hash = samples.hash();
  const FeatureMatrix matrix = feature_matrix(samples, settings.features);
  forest.ranges_ = measure_ranges(matrix);

  std::vector<BaggingTarget> targets(3);
  std::vector<double> values(samples.size());
  for (int mode = 0; mode < 3; ++mode) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = label(samples[i], settings.features)[mode];
    const auto [mean, deviation] = moments(values);
    forest.label_mean_[mode] = mean;
    forest.label_scale_[mode] = deviation;
    BaggingTarget& target = targets[static_cast<std::size_t>(mode)];
    target.stream = static_cast<std::uint64_t>(mode);
    for (const double v : values)
      target.values.push_back(single((v - mean) / deviation));
  }

  int done = 0;
  const auto step = [&] {
    if (progress) progress(++done, 3 * settings.trees);
  };
  const auto trees = fit_bagged_trees(single_rows(matrix.values), matrix.columns, targets,
                                      {settings.trees, settings.depth, settings.seed, settings.bins}, step);
  for (std::size_t mode = 0; mode < 3; ++mode)
    forest.ensembles_[mode] = TreeEnsemble(trees[mode], static_cast<int>(matrix.columns));
  return forest;
}

Prediction RegressionForest::predict(std::span<const double> row) const {
  return predict(FeatureMatrix{settings_.features, row.size(), {row.begin(), row.end()}}).front();
}

std::vector<Prediction> RegressionForest::predict(const FeatureMatrix& matrix) const {
  if (matrix.set != settings_.features || matrix.columns != ranges_.size())
    throw InputError("the forest was trained with feature set " + std::string(name(settings_.features)) +
                     ", the data are of " + std::string(name(matrix.set)) + " (" +
                     std::to_string(matrix.columns) +
                     " features); compute the features of the forest's own set or train another forest");
  const std::vector<float> rows = single_rows(matrix.values);
  std::vector<Prediction> result(matrix.rows());
  parallel_for(result.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<TreeEnsemble::Answer> answers(end - begin);
    for (int mode = 0; mode < 3; ++mode) {
      ensemble(mode).evaluate(std::span(rows).subspan(begin * matrix.columns, (end - begin) * matrix.columns),
                              answers);
      for (std::size_t i = begin; i < end; ++i) {
        result[i].mean[mode] = label_mean_[mode] + label_scale_[mode] * answers[i - begin].mean;
        result[i].spread[mode] = label_scale_[mode] * answers[i - begin].spread;
      }
    }
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t c = 0; c < matrix.columns; ++c) {
        if (!within(matrix.row(i)[c], ranges_[c])) result[i].in_range = false;
      }
  });
  return result;
}

std::vector<OpeningPrediction> RegressionForest::predict_openings(const SampleSet& samples) const {
  const std::vector<Prediction> labels = predict(feature_matrix(samples, settings_.features));
  std::vector<OpeningPrediction> result(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    result[i] = {opening_from_label(s, settings_.features, labels[i].mean),
                 opening_spread(s, settings_.features, labels[i].spread), labels[i].in_range};
  }
  return result;
}

std::vector<std::string> RegressionForest::out_of_range(std::span<const double> row) const {
  const std::vector<std::string> names = feature_names(settings_.features);
  std::vector<std::string> result;
  for (std::size_t c = 0; c < std::min(row.size(), ranges_.size()); ++c) {
    if (within(row[c], ranges_[c])) continue;
    std::ostringstream text;
    text << names[c] << " = " << row[c] << " (trained on " << ranges_[c].minimum << " ... "
         << ranges_[c].maximum << ")";
    result.push_back(text.str());
  }
  return result;
}

}  // namespace conchoid
