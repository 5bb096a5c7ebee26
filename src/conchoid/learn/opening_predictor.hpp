#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "conchoid/learn/sample.hpp"

namespace conchoid {

/// Predicted opening of one sample.
struct OpeningPrediction {
  Vec3 opening = Vec3::Zero();  ///< Δu [m] in the front frame of frame n−1
  Vec3 spread = Vec3::Zero();   ///< its standard deviation [m]; 0 where the predictor states none
  bool in_range = true;         ///< false: asked beyond what it was trained on
  /// K that drives the front of frame n, in its own front frame [Pa√m]; none: what belongs to the opening
  std::optional<Vec3> driving = {};
  /// Standard deviation of K_II and K_III of it at the size that it has [Pa√m]; first component zero
  Vec3 driving_spread = Vec3::Zero();
};

/// Predicts openings from what was known in the frame before: a trained regressor, or a closed form.
class OpeningPredictor {
 public:
  virtual ~OpeningPredictor() = default;
  /// As reports name it.
  virtual std::string_view name() const = 0;
  /// Whether it looks at fields of the samples that have to be measured around the front (sim/front_surroundings.hpp).
  virtual bool looks_around() const { return false; }
  /// Whether the spread was compared with errors on runs that the predictor had not seen, and is to be taken as it is.
  virtual bool calibrated() const { return false; }
  /// One prediction per sample. Uses everything of the samples but their opening.
  virtual std::vector<OpeningPrediction> predict_openings(const SampleSet& samples) const = 0;
};

/// "K stays as it is": the closed-form inverse of the displacement correlation (steady_opening). No training.
const OpeningPredictor& steady_predictor();

}  // namespace conchoid
