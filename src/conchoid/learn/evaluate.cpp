#include "conchoid/learn/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/bagging.hpp"

namespace conchoid {
namespace {

std::vector<std::int32_t> distinct_runs(const SampleSet& samples) {
  const std::set<std::int32_t> runs(samples.run().begin(), samples.run().end());
  return {runs.begin(), runs.end()};
}

}  // namespace

Split split_by_run(const SampleSet& samples, double fraction, std::uint64_t seed) {
  if (!(fraction > 0 && fraction < 1))
    throw InputError("the share of runs to hold out must lie between 0 and 1");
  std::vector<std::int32_t> runs = distinct_runs(samples);
  if (runs.size() < 2)
    throw InputError(
        "holding out whole runs needs at least two runs with samples; generate a larger database");
  // A run's place in the draw depends on its id and the seed alone.
  std::sort(runs.begin(), runs.end(), [seed](std::int32_t a, std::int32_t b) {
    const auto key = [seed](std::int32_t run) {
      return std::pair(stream_seed(seed, 0x73706c6974u, static_cast<std::uint64_t>(run)), run);
    };
    return key(a) < key(b);
  });
  const auto wanted = static_cast<std::size_t>(std::lround(fraction * static_cast<double>(runs.size())));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, runs.size() - 1);
  const std::set<std::int32_t> chosen(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<std::size_t> training, held_out;
  for (std::size_t i = 0; i < samples.size(); ++i)
    (chosen.contains(samples.run()[i]) ? held_out : training).push_back(i);
  return {samples.subset(training), samples.subset(held_out)};
}

Accuracy accuracy(const SampleSet& samples, const std::vector<Vec3>& openings) {
  const auto n = static_cast<double>(samples.size());
  Vec3 mean = Vec3::Zero(), error = Vec3::Zero(), variance = Vec3::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    mean += s.opening / s.resolution / n;
    error += ((openings[i] - s.opening) / s.resolution).cwiseAbs2();
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    variance += (s.opening / s.resolution - mean).cwiseAbs2();
  }
  Accuracy result;
  for (int mode = 0; mode < 3; ++mode) {
    result.rmse[mode] = std::sqrt(error[mode] / n);
    // Labels that do not vary: explained if met exactly, else not at all.
    result.r2[mode] = variance[mode] > 0 ? 1 - error[mode] / variance[mode] : (error[mode] > 0 ? 0.0 : 1.0);
  }
  return result;
}

namespace {

// Of many K at once; only those that pull.
class DirectionError {
 public:
  void add(const Vec3& predicted, const Vec3& actual) {
    if (!(actual[0] > 0)) return;
    const double error = std::atan2(predicted[1], predicted[0]) - std::atan2(actual[1], actual[0]);
    sum_ += error * error;
    ++count_;
  }
  std::optional<double> root_mean_square() const {
    if (count_ == 0) return std::nullopt;
    return std::sqrt(sum_ / static_cast<double>(count_));
  }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

Score score(const OpeningPredictor& predictor, const SampleSet& samples) {
  Score result;
  result.name = predictor.name();
  std::vector<Vec3> openings;
  DirectionError direction;
  const std::vector<OpeningPrediction> predictions = predictor.predict_openings(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    openings.push_back(predictions[i].opening);
    if (predictions[i].driving) direction.add(*predictions[i].driving, samples[i].driving_after);
    result.in_range += predictions[i].in_range;
    result.spread +=
        (predictions[i].spread / samples[i].resolution).cwiseAbs2() / static_cast<double>(samples.size());
  }
  result.spread = result.spread.cwiseSqrt();
  result.direction_error = direction.root_mean_square();
  result.accuracy = accuracy(samples, openings);
  return result;
}

Evaluation evaluate(const Regressor& model, const SampleSet& samples,
                    const std::vector<const OpeningPredictor*>& baselines) {
  if (samples.empty())
    throw InputError("there are no samples to evaluate on; name a database with runs that crack");
  samples.validate();
  require_recorded(model.feature_set(), samples);
  Evaluation result;
  result.samples = samples.size();
  result.runs = distinct_runs(samples).size();
  result.seen_in_training = samples.hash() == model.provenance().samples_hash;
  result.model = score(model, samples);
  if (model.looks_around()) {
    DirectionError kept;
    for (std::size_t i = 0; i < samples.size(); ++i)
      kept.add(samples[i].driving, samples[i].driving_after);
    result.kept_direction_error = kept.root_mean_square();
  }
  for (const OpeningPredictor* baseline : baselines)
    result.baselines.push_back(score(*baseline, samples));
  return result;
}

}  // namespace conchoid
