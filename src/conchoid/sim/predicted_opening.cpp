#include "conchoid/sim/predicted_opening.hpp"

#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/sim/front_gaps.hpp"

namespace conchoid {
PredictedOpening::PredictedOpening(const PredictionContext& c)
    : bem_(c.bem),
      sif_(c.sif),
      material_(c.material.elastic()),
      solve_every_(c.solve_every),
      history_(c.material, c.body.toughness, c.body.crack_edge) {}

bool PredictedOpening::solve(const CrackState& crack, std::vector<FrontOpening>& out) {
  const int frame = crack.sheet.frame;  // 0 for the first
  if (!solves(frame)) return false;
  try {
    out = bem_.open(crack);
    return true;
  } catch (const SingularSystem&) {
    if (frame == 0) throw;
    return false;
  }
}

std::vector<FrontOpening> PredictedOpening::open(const CrackState& crack) {
  std::vector<FrontOpening> out;
  look_at(crack);
  solved_ = solve(crack, out);
  if (!solved_) {
    out = predict(crack);
    fill_gaps(point_chains(crack), out);
  }
  history_.remember(crack, out);
  remember(crack, out);
  return out;
}

void PredictedOpening::set_intensity(const FrontPoint& point, const Vec3& K, FrontOpening& out) const {
  out.intensity = out.node_intensity = K;
  if (point.distance > 0)
    out.opening =
        in_world(point.frame, opening_from_intensity(K, point.distance, material_, sif_.convention));
}

OpeningByPredictor::OpeningByPredictor(const PredictionContext& c, const OpeningPredictor& predictor)
    : PredictedOpening(c), predictor_(predictor), bem_(c.bem) {
  if (predictor.looks_around()) surroundings_ = std::make_unique<FrontSurroundings>(c.body);
}

void OpeningByPredictor::look_at(const CrackState& crack) {
  if (surroundings_) surroundings_->measure(crack, bem_.body().load(), bem_.loads());
}

void OpeningByPredictor::remember(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  if (surroundings_) surroundings_->remember(crack, openings);
}

std::vector<FrontOpening> OpeningByPredictor::predict(const CrackState& crack) const {
  std::vector<FrontOpening> out(crack.points.size());
  SampleSet samples;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    if (const FrontHistory::Entry* still = history().find(point.node)) {  // it did not move: nothing changes
      out[i].intensity = out[i].node_intensity = surroundings_ ? still->driving : still->intensity;
    } else if (auto sample = history().sample(crack, point)) {
      if (surroundings_) surroundings_->complete(crack, i, *sample);
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
    FrontOpening& o = out[asked[p]];
    o.in_range = predictions[p].in_range;
    if (predictions[p].driving) {
      set_intensity(point, *predictions[p].driving, o);
      continue;
    }
    o.opening = in_world(history().find(point.correlation)->frame, predictions[p].opening);
    o.intensity = o.node_intensity =
        stress_intensity(in_frame(point.frame, o.opening), point.distance, material(), sif().convention);
  }
  return out;
}

std::vector<FrontOpening> KeptOpening::predict(const CrackState& crack) const {
  std::vector<FrontOpening> out(crack.points.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontHistory::Entry* last = history().find(point.node);
    if (!last && point.correlation.valid()) last = history().find(point.correlation);
    out[i].known = last != nullptr;
    if (!last) continue;
    set_intensity(point, last->driving, out[i]);
  }
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
