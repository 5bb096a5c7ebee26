#pragma once

#include <array>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// Samples made ready for the training of any regressor; where the feature set has images (features.hpp), all samples
/// once for each.
struct TrainingData {
  TrainingRecord record;
  FeatureMatrix rows;
  std::vector<std::int32_t> run;              ///< per row
  std::array<std::vector<double>, 3> labels;  ///< per mode, one per row, of zero mean and unit deviation
};

/// The numbers of runs and samples and the hash in the provenance are filled in here.
/// Throws InputError if there are no samples, if one is not valid, or if the feature set looks at quantities
/// that are zero in every sample.
TrainingData prepare_training(const SampleSet& samples, FeatureSet features, Provenance provenance);

/// Mean and standard deviation (divided by n); a deviation of zero is given as one.
struct Moments {
  double mean = 0, deviation = 1;
};
Moments moments(const std::vector<double>& values);

}  // namespace conchoid
