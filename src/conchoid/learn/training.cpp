#include "conchoid/learn/training.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

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

}  // namespace

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

TrainingData prepare_training(const SampleSet& samples, FeatureSet features, Provenance provenance) {
  samples.validate();
  if (samples.empty())
    throw InputError("there are no samples to learn from; generate a database with runs that crack");
  require_recorded(features, samples);
  TrainingData data;
  data.record.features = features;
  data.record.provenance = std::move(provenance);
  data.record.provenance.samples = samples.size();
  data.record.provenance.runs = std::set<std::int32_t>(samples.run().begin(), samples.run().end()).size();
  data.record.provenance.samples_hash = samples.hash();
  const int images = image_count(features);
  data.rows = feature_matrix(samples, features);
  hide_features(data.rows, data.record.provenance.hidden_features);
  const std::vector<double> plain = data.rows.values;
  const std::vector<std::int32_t> stretch = data.rows.stretch;
  data.run = samples.run();
  for (int image = 1; image < images; ++image) {
    data.rows.values.insert(data.rows.values.end(), plain.begin(), plain.end());
    data.run.insert(data.run.end(), samples.run().begin(), samples.run().end());
    for (const std::int32_t s : stretch)
      data.rows.stretch.push_back(s + image * (stretch.back() + 1));
    for (std::size_t i = 0; i < samples.size(); ++i)
      apply_image(features, image, data.rows.row_of(static_cast<std::size_t>(image) * samples.size() + i));
  }
  data.record.ranges = measure_ranges(data.rows);
  for (int mode = 0; mode < 3; ++mode) {
    std::vector<double>& values = data.labels[static_cast<std::size_t>(mode)];
    values.resize(data.rows.rows());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = label_image(features, static_cast<int>(i / samples.size()),
                              label(samples[i % samples.size()], features))[mode];
    const auto [mean, deviation] = moments(values);
    data.record.label_mean[mode] = mean;
    data.record.label_scale[mode] = deviation;
    for (double& v : values)
      v = (v - mean) / deviation;
  }
  return data;
}

}  // namespace conchoid
