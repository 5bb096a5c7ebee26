#pragma once

#include <cstdint>

#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/sample.hpp"

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

struct Evaluation {
  std::size_t samples = 0, runs = 0;
  Accuracy forest;
  Accuracy baseline_steady;  ///< "K stays as it is", no training
  std::size_t in_range = 0;  ///< samples whose features lie within the range of the training
  Vec3 spread =
      Vec3::Zero();  ///< root mean square of the spread between the trees, of Δu/r̄: to compare with rmse
  bool seen_in_training =
      false;  ///< these are exactly the samples the forest was trained on: the figures flatter it
};

/// Accuracy of any predicted openings [m] for samples.
Accuracy accuracy(const SampleSet& samples, const std::vector<Vec3>& openings);

/// One-step accuracy of a forest and of the steady baseline on the same samples. Throws InputError if there
/// are none.
Evaluation evaluate(const RegressionForest& forest, const SampleSet& samples);

}  // namespace conchoid
