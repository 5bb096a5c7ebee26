#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/sim/front_gaps.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {
namespace {

Vec3 in_world(const FrontFrame& f, const Vec3& v) {
  return v[0] * f.e1 + v[1] * f.e2 + v[2] * f.e3;
}

}  // namespace

std::vector<FrontOpening> PredictedOpening::predict(const CrackState& crack) const {
  std::vector<FrontOpening> out(crack.points.size());
  SampleSet samples;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    if (const FrontHistory::Entry* still = history_.find(point.node)) {  // it did not move: nothing changes
      out[i].intensity = out[i].node_intensity = still->intensity;
    } else if (const auto sample = history_.sample(crack, point)) {
      samples.add(*sample);
      asked.push_back(i);
    } else {
      out[i].known = false;
    }
  }
  if (samples.empty()) return out;
  const std::vector<OpeningPrediction> predictions = predictor_.predict_openings(samples);
  for (std::size_t p = 0; p < predictions.size(); ++p) {
    const FrontPoint& point = crack.points[asked[p]];
    const Sample s = samples[p];
    FrontOpening& o = out[asked[p]];
    o.opening = in_world(history_.find(point.correlation)->frame, predictions[p].opening);
    o.intensity = o.node_intensity = stress_intensity(in_frame(point.frame, o.opening), point.distance,
                                                      {s.youngs_modulus, s.poisson_ratio}, sif_.convention);
    o.in_range = predictions[p].in_range;
  }
  return out;
}

std::vector<FrontOpening> PredictedOpening::open(const CrackState& crack) {
  std::vector<FrontOpening> out;
  if (crack.sheet.frame == 0) {
    out = first_.open(crack);
  } else {
    out = predict(crack);
    fill_gaps(point_chains(crack), out);
  }
  history_.remember(crack, out);
  return out;
}

std::vector<FrontOpening> carried_openings(const CrackState& crack, const FrontHistory& history,
                                           const GrowthLaw& law) {
  std::vector<FrontOpening> out(crack.points.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontHistory::Entry* last = history.find(point.node);
    if (!last && point.correlation.valid()) last = history.find(point.correlation);
    out[i].known = last != nullptr;
    if (last) out[i].intensity = out[i].node_intensity = law.drive(last->intensity) * Vec3::UnitX();
  }
  fill_gaps(point_chains(crack), out);
  return out;
}

}  // namespace conchoid
