#include "conchoid/learn/inspection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/bagging.hpp"

namespace conchoid {
namespace {

// Every n-th.
SampleSet at_most(const SampleSet& samples, std::size_t count) {
  if (samples.size() <= count) return samples;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(i * samples.size() / count);
  return samples.subset(chosen);
}

void require_samples(const Regressor& regressor, const SampleSet& samples) {
  if (samples.empty())
    throw InputError(
        "there are no samples to inspect by; name a database with runs that crack, or a scene "
        "whose crack grows over several frames");
  require_recorded(regressor.feature_set(), samples);
}

double& entry(FeatureMatrix& rows, std::size_t row, std::size_t column) {
  return rows.values[row * rows.columns + column];
}

Vec3 mean_square_error(const std::vector<Prediction>& predictions, const std::vector<Vec3>& labels) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < labels.size(); ++i)
    sum += (predictions[i].mean - labels[i]).cwiseAbs2();
  return sum / static_cast<double>(labels.size());
}

Vec3 variance(const std::vector<Vec3>& labels) {
  const auto n = static_cast<double>(labels.size());
  const Vec3 mean = std::accumulate(labels.begin(), labels.end(), Vec3(Vec3::Zero())) / n;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& label : labels)
    sum += (label - mean).cwiseAbs2();
  return sum / n;
}

// Portable: drawn by a generator and a rule that are the same everywhere.
std::vector<std::size_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 generator(seed);
  for (std::size_t i = n; i > 1; --i)
    std::swap(order[i - 1], order[generator() % i]);
  return order;
}

std::vector<FeatureInfluence::Dependence> partial_dependence(const Regressor& regressor,
                                                             const FeatureMatrix& rows, std::size_t column) {
  std::vector<FeatureInfluence::Dependence> out;
  for (const double value : regressor.ranges()[column].quantiles) {
    if (!out.empty() && out.back().value == value) continue;
    FeatureMatrix changed = rows;
    for (std::size_t i = 0; i < rows.rows(); ++i)
      entry(changed, i, column) = value;
    FeatureInfluence::Dependence at{value};
    for (const Prediction& p : regressor.predict(changed))
      at.mean += p.mean / static_cast<double>(rows.rows());
    out.push_back(at);
  }
  return out;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// What the features are divided by before distances are taken; 0: constant in the training.
std::vector<double> feature_scales(const Regressor& regressor) {
  std::vector<double> scales;
  for (const FeatureRange& range : regressor.ranges()) {
    const double middle = range.quantiles[5] - range.quantiles[1];
    scales.push_back(middle > 0 ? middle : range.maximum - range.minimum);
  }
  return scales;
}

double squared_distance(std::span<const double> a, std::span<const double> b,
                        const std::vector<double>& scales) {
  constexpr double same = 1e-9;
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const double apart = std::abs(a[c] - b[c]);
    const double d = scales[c] > 0 ? apart / scales[c] : (apart > same * std::abs(b[c]) ? 1.0 : 0.0);
    sum += d * d;
  }
  return sum;
}

/// Nearest of some other rows.
struct Nearest {
  std::size_t row = 0;
  double distance = std::numeric_limits<double>::infinity();
};

/// @param skip  whether not to count that pair
template <class Skip>
std::vector<Nearest> nearest_rows(const FeatureMatrix& from, const FeatureMatrix& to,
                                  const std::vector<double>& scales, const Skip& skip) {
  std::vector<Nearest> out(from.rows());
  parallel_for(out.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = 0; j < to.rows(); ++j) {
        if (skip(i, j)) continue;
        const double d = squared_distance(from.row(i), to.row(j), scales);
        if (d < out[i].distance) out[i] = {j, d};
      }
      out[i].distance = std::sqrt(out[i].distance);
    }
  });
  return out;
}

std::vector<double> distances(const std::vector<Nearest>& nearest) {
  std::vector<double> out;
  for (const Nearest& n : nearest)
    out.push_back(n.distance);
  return out;
}

std::vector<Vec3> labels_of(const SampleSet& samples, FeatureSet set) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < samples.size(); ++i)
    out.push_back(label(samples[i], set));
  return out;
}

/// Root mean square difference from the labels of the nearest, over the deviation of the latter's whole set.
Vec3 labels_apart(const std::vector<Vec3>& labels, const std::vector<Nearest>& nearest,
                  const std::vector<Vec3>& there) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < labels.size(); ++i)
    sum += (labels[i] - there[nearest[i].row]).cwiseAbs2() / static_cast<double>(labels.size());
  const Vec3 spread = variance(there);
  for (int mode = 0; mode < 3; ++mode)
    sum[mode] = spread[mode] > 0 ? std::sqrt(sum[mode] / spread[mode]) : 0;
  return sum;
}

}  // namespace

std::vector<FeatureInfluence> feature_influences(const Regressor& regressor, const SampleSet& all,
                                                 std::uint64_t seed) {
  require_samples(regressor, all);
  const SampleSet samples = at_most(all, kInfluenceSamples);
  const FeatureSet set = regressor.feature_set();
  const FeatureMatrix rows = feature_matrix(samples, set);
  const std::vector<Vec3> labels = labels_of(samples, set);
  const Vec3 error = mean_square_error(regressor.predict(rows), labels), spread = variance(labels);
  std::vector<FeatureInfluence> out;
  for (std::size_t c = 0; c < rows.columns; ++c) {
    const std::vector<std::size_t> other = shuffled(rows.rows(), stream_seed(seed, 0x696e7370u, c));
    FeatureMatrix exchanged = rows;
    for (std::size_t i = 0; i < rows.rows(); ++i)
      entry(exchanged, i, c) = rows.row(other[i])[c];
    FeatureInfluence influence{feature_names(set)[c], Vec3::Zero(), partial_dependence(regressor, rows, c)};
    const Vec3 worse = mean_square_error(regressor.predict(exchanged), labels) - error;
    for (int mode = 0; mode < 3; ++mode)
      influence.importance[mode] = spread[mode] > 0 ? worse[mode] / spread[mode] : 0;
    out.push_back(std::move(influence));
  }
  return out;
}

RangeCoverage range_coverage(const Regressor& regressor, const SampleSet& samples) {
  require_samples(regressor, samples);
  const FeatureMatrix rows = feature_matrix(samples, regressor.feature_set());
  RangeCoverage out;
  out.samples = rows.rows();
  for (const Prediction& p : regressor.predict(rows))
    out.in_range += p.in_range;
  const std::vector<std::string> names = feature_names(regressor.feature_set());
  const double one = 1 / static_cast<double>(rows.rows());
  for (std::size_t c = 0; c < rows.columns; ++c) {
    const FeatureRange& range = regressor.ranges()[c];
    RangeCoverage::Feature feature{names[c], 0, 0, 0, range.quantiles[3]};
    std::vector<double> values;
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      const double x = rows.row(i)[c];
      values.push_back(x);
      if (!within_range(x, range.minimum, range.maximum)) feature.outside += one;
      if (!within_range(x, range.quantiles.front(), range.quantiles.back())) feature.in_the_tails += one;
    }
    feature.median = quantile(values, 0.5);
    out.features.push_back(std::move(feature));
  }
  return out;
}

NeighbourCoverage neighbour_coverage(const Regressor& regressor, const SampleSet& training,
                                     const SampleSet& samples) {
  require_samples(regressor, samples);
  require_samples(regressor, training);
  const FeatureSet set = regressor.feature_set();
  const std::vector<double> scales = feature_scales(regressor);
  const SampleSet some = at_most(samples, kNeighbourSamples),
                  of_training = at_most(training, kNeighbourSamples);
  const FeatureMatrix there = feature_matrix(training, set);
  const std::vector<Nearest> own =
      nearest_rows(feature_matrix(of_training, set), there, scales,
                   [&](std::size_t i, std::size_t j) { return of_training.run()[i] == training.run()[j]; });
  if (!std::isfinite(own.front().distance))
    throw InputError(
        "the training samples are of one run alone, which says nothing of how far others lie; "
        "name the database that the regressor was trained on");
  const std::vector<Nearest> nearest =
      nearest_rows(feature_matrix(some, set), there, scales, [](std::size_t, std::size_t) { return false; });
  const std::vector<double> distance = distances(nearest), own_distance = distances(own);
  const std::vector<Vec3> labels = labels_of(training, set);
  NeighbourCoverage out{quantile(distance, 0.5),
                        quantile(distance, 0.95),
                        quantile(own_distance, 0.5),
                        quantile(own_distance, 0.95),
                        0,
                        labels_apart(labels_of(some, set), nearest, labels),
                        labels_apart(labels_of(of_training, set), own, labels)};
  const auto near =
      std::count_if(distance.begin(), distance.end(), [&](double d) { return d <= out.own_p95; });
  out.covered = static_cast<double>(near) / static_cast<double>(distance.size());
  return out;
}

}  // namespace conchoid
