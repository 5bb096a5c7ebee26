#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// Samples in two parts that share no run.
struct Split {
  SampleSet training, held_out;
};

/// Holds out whole runs, drawn without replacement: round(fraction × runs), but at least one in each part.
/// @param fraction  0 < fraction < 1
/// Throws InputError if there are fewer than two runs.
Split split_by_run(const SampleSet& samples, double fraction, std::uint64_t seed);

/// How well openings are predicted, per mode.
struct Accuracy {
  Vec3 rmse = Vec3::Zero();  ///< root mean square error of Δu/r̄
  Vec3 r2 = Vec3::Zero();  ///< 1 − Σ error² / Σ (Δu/r̄ − mean)², 1 = perfect, 0 = no better than the mean
};

/// What one predictor does on some samples.
struct Score {
  std::string name;  ///< OpeningPredictor::name
  Accuracy accuracy;
  std::size_t in_range = 0;  ///< samples that are not beyond its training
  /// Root mean square of the spread that it states, of Δu/r̄: to compare with rmse.
  Vec3 spread = Vec3::Zero();
  /// Root mean square error of atan2(K_II, K_I) of the K that drives the front, which is what turns it [rad]; none where
  /// that is not told.
  std::optional<double> direction_error = {};
};

struct Evaluation {
  std::size_t samples = 0, runs = 0;
  Score model;
  std::vector<Score> baselines;
  /// As Score::direction_error, of K kept in the front's own frame; none where samples do not hold it.
  std::optional<double> kept_direction_error = {};
  /// These are exactly the samples the model was trained on: the figures flatter it.
  bool seen_in_training = false;
};

/// Accuracy of any predicted openings [m] for samples.
Accuracy accuracy(const SampleSet& samples, const std::vector<Vec3>& openings);
Score score(const OpeningPredictor& predictor, const SampleSet& samples);

/// One-step accuracy of a regressor and of baselines on the same samples. Throws InputError if there are
/// none, or if they lack what its feature set looks at.
Evaluation evaluate(const Regressor& model, const SampleSet& samples,
                    const std::vector<const OpeningPredictor*>& baselines = {&steady_predictor()});

}  // namespace conchoid
