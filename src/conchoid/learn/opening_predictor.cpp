#include "conchoid/learn/opening_predictor.hpp"

#include "conchoid/learn/features.hpp"

namespace conchoid {
namespace {

class SteadyPredictor : public OpeningPredictor {
 public:
  std::string_view name() const override { return "steady"; }
  std::vector<OpeningPrediction> predict_openings(const SampleSet& samples) const override {
    std::vector<OpeningPrediction> result(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
      result[i].opening = steady_opening(samples[i]);
    return result;
  }
};

}  // namespace

const OpeningPredictor& steady_predictor() {
  static const SteadyPredictor predictor;
  return predictor;
}

}  // namespace conchoid
