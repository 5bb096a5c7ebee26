#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// What one feature does to the answers of a regressor, over some samples.
struct FeatureInfluence {
  std::string name;
  /// Per mode the R² of the label that is lost when the feature's values are exchanged at random among the
  /// samples: 0 for a feature that is not looked at, above 1 for one that leads far astray. Of features that tell
  /// the same, each seems small.
  Vec3 importance = Vec3::Zero();
  struct Dependence {
    double value = 0;          ///< of the feature
    Vec3 mean = Vec3::Zero();  ///< answer in the mean over the samples, each with this value
  };
  std::vector<Dependence> dependence;  ///< partial dependence, at the quantiles of the training
};

/// Influence of every feature. At most kInfluenceSamples of the samples count, drawn evenly from their list.
/// Throws InputError for no samples, for samples without what the regressor looks at, and as Regressor::predict does.
std::vector<FeatureInfluence> feature_influences(const Regressor& regressor, const SampleSet& samples,
                                                 std::uint64_t seed = 1);
inline constexpr std::size_t kInfluenceSamples = 2000;

/// How far samples lie where a regressor was trained, feature by feature.
struct RangeCoverage {
  std::size_t samples = 0,
              in_range = 0;  ///< in_range: every feature between smallest and largest of the training
  struct Feature {
    std::string name;
    double outside = 0;       ///< share of samples beyond the training's smallest or largest value
    double in_the_tails = 0;  ///< share beyond its 1 % or 99 % quantile; 0.02 for the training itself
    double median = 0, training_median = 0;
  };
  std::vector<Feature> features;
};
RangeCoverage range_coverage(const Regressor& regressor, const SampleSet& samples);

/// How near samples lie to some of the training, in all features together. The distance of two samples is
/// Euclidean in features over the range from the 5 % to the 95 % quantile of the training; one that the training
/// keeps constant counts 1 where it differs.
struct NeighbourCoverage {
  double median = 0, p95 = 0;          ///< distance of the samples from their nearest ones in the training
  double own_median = 0, own_p95 = 0;  ///< the same within the training, between different runs
  double covered = 0;                  ///< share of samples that are nearer than own_p95
  /// Root mean square difference of the label from that of the nearest sample of the training, per mode over the
  /// standard deviation of the labels there; the same within the training, between different runs. Where samples
  /// are near and their labels far, what follows from the same features is another.
  Vec3 labels_apart = Vec3::Zero(), own_labels_apart = Vec3::Zero();
};
/// At most kNeighbourSamples of either count for the distances from, all of the training for those to.
/// Throws InputError for no samples, or training samples of one run alone.
NeighbourCoverage neighbour_coverage(const Regressor& regressor, const SampleSet& training,
                                     const SampleSet& samples);
inline constexpr std::size_t kNeighbourSamples = 1000;

}  // namespace conchoid
