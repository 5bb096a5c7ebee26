#include "conchoid/sim/predicted_opening.hpp"

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/sim/frames_ahead.hpp"
#include "conchoid/sim/front_gaps.hpp"
#include "conchoid/sim/front_pasts.hpp"

namespace conchoid {
namespace {

double diagonal_of(const PreparedBody& body) {
  if (!body.infinite()) return bounding_box(body.surface).diagonal();
  double diagonal = 0;  // of the largest crack
  for (const TriMesh& crack : body.cracks)
    diagonal = std::max(diagonal, bounding_box(crack).diagonal());
  return diagonal;
}

}  // namespace

bool may_predict(double expected, double tolerance, bool solving) {
  return expected <= (solving ? kShareToStopSolving * tolerance : tolerance);
}

PredictedOpening::PredictedOpening(const PredictionContext& c, const ExpectedError::Statement& statement)
    : bem_(c.bem),
      surface_(c.body.surface),
      crack_edge_(c.body.crack_edge),
      sif_(c.sif),
      material_(c.material.elastic()),
      toughness_(c.material.toughness),
      toughness_factor_(c.body.toughness),
      solve_every_(c.solve_every),
      tolerance_(c.tolerance),
      error_(material_, diagonal_of(c.body), c.body.crack_edge, statement),
      history_(c.material, c.body.toughness, c.body.crack_edge) {}

bool PredictedOpening::is_due(int frame) const {
  return frame == 0 || (solve_every_ > 0 && frame % solve_every_ == 0) || tolerance_ == 0.0;
}

// Frames that cannot be solved are predicted; not where the solution is wanted as it is without predictions.
std::optional<std::vector<FrontOpening>> PredictedOpening::solve(const CrackState& crack) {
  try {
    return bem_.open(crack);
  } catch (const SingularSystem&) {
    if (crack.sheet.frame == 0 || looks()) throw;
    return {};
  }
}

// A front that has just come into the body, with no point that anything is known of, goes by K nearest to it.
std::vector<FrontOpening> PredictedOpening::predicted(const CrackState& crack) const {
  std::vector<FrontOpening> out = predict(crack);
  fill_gaps(point_chains(crack), out);
  if (std::all_of(out.begin(), out.end(), [](const FrontOpening& o) { return o.known; })) return out;
  const std::vector<FrontPast> pasts = front_pasts(crack, history_);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i].known || pasts[i].nodes.empty()) continue;
    set_intensity(crack.points[i], history_.find(pasts[i].nodes[0])->driving, out[i]);
    out[i].known = true;
  }
  return out;
}

bool PredictedOpening::any_moves(const CrackState& crack, const std::vector<FrontOpening>& predicted) const {
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Vec3& x = crack.sheet.mesh.positions[crack.points[i].node];
    if (effective_intensity(predicted[i].intensity, material_) >= toughness_ * toughness_factor_.at(x).value)
      return true;
  }
  return predicted.empty();  // fronts that are through are not arrested
}

bool PredictedOpening::is_good(const CrackState& crack, const std::vector<FrontOpening>& predicted) const {
  if (!looks()) return true;
  const double expected = error_.at_the_end(crack, predicted, frames_ahead(crack, surface_, crack_edge_));
  return may_predict(expected, *tolerance_, solved_) && any_moves(crack, predicted);
}

std::vector<FrontOpening> PredictedOpening::open(const CrackState& crack) {
  const bool due = is_due(crack.sheet.frame);
  look_at(crack);
  std::vector<FrontOpening> guess;
  if (!due) guess = predicted(crack);
  std::optional<std::vector<FrontOpening>> exact;
  if (due || !is_good(crack, guess)) exact = solve(crack);
  if (due && !exact) guess = predicted(crack);
  solved_ = exact.has_value();
  if (solved_)
    error_.advance_solved(crack, *exact, guess);
  else
    error_.advance_predicted(crack, guess);
  std::vector<FrontOpening> out = solved_ ? std::move(*exact) : std::move(guess);
  history_.remember(crack, out);
  remember(crack, out);
  return out;
}

std::optional<double> PredictedOpening::expected_error() const {
  return tolerance_ ? std::optional(error_.of_surface()) : std::nullopt;
}

void PredictedOpening::take_carried(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  error_.advance_predicted(crack, openings);
  history_.remember(crack, openings);
  remember(crack, openings);
  solved_ = false;
}

void PredictedOpening::set_intensity(const FrontPoint& point, const Vec3& K, FrontOpening& out) const {
  out.intensity = out.node_intensity = K;
  if (point.distance > 0)
    out.opening =
        in_world(point.frame, opening_from_intensity(K, point.distance, material_, sif_.convention));
}

OpeningByPredictor::OpeningByPredictor(const PredictionContext& c, const OpeningPredictor& predictor)
    : PredictedOpening(c, predictor.calibrated() ? ExpectedError::kCalibrated : ExpectedError::kUnknown),
      predictor_(predictor) {
  if (predictor.looks_around()) surroundings_ = std::make_unique<FrontSurroundings>(c.body);
}

void OpeningByPredictor::look_at(const CrackState& crack) {
  if (surroundings_) surroundings_->measure(crack, bem().body().load(), bem().loads());
}

void OpeningByPredictor::remember(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  if (surroundings_) surroundings_->remember(crack, openings);
}

namespace {

// Of the two that a point with a neighbour on each side is told.
FrontOpening mean(const FrontOpening& a, const FrontOpening& b) {
  FrontOpening m;
  m.opening = (a.opening + b.opening) / 2;
  m.intensity = (a.intensity + b.intensity) / 2;
  m.node_intensity = (a.node_intensity + b.node_intensity) / 2;
  m.spread = (a.spread + b.spread) / 2;
  m.in_range = a.in_range && b.in_range;
  return m;
}

}  // namespace

// Deviation of K in a point's frame from that of the opening in the frame that the point had before, whose
// components are independent.
Vec3 OpeningByPredictor::turned_spread(const FrontFrame& before, const FrontPoint& point,
                                       const Vec3& spread) const {
  Vec3 variance = Vec3::Zero();
  for (int mode = 0; mode < 3; ++mode) {
    const Vec3 K = stress_intensity(in_frame(point.frame, in_world(before, spread[mode] * Vec3::Unit(mode))),
                                    point.distance, material(), sif().convention);
    variance += K.cwiseAbs2();
  }
  return variance.cwiseSqrt();
}

FrontOpening OpeningByPredictor::answer(const FrontPoint& point, NodeId old,
                                        const OpeningPrediction& prediction) const {
  FrontOpening o;
  o.in_range = prediction.in_range;
  if (prediction.driving) {
    set_intensity(point, *prediction.driving, o);
    o.spread = prediction.driving_spread;
    return o;
  }
  const FrontFrame& before = history().find(old)->frame;
  o.opening = in_world(before, prediction.opening);
  o.intensity = o.node_intensity =
      stress_intensity(in_frame(point.frame, o.opening), point.distance, material(), sif().convention);
  o.spread = turned_spread(before, point, prediction.spread);
  return o;
}

// A predictor that looks around is asked for points that were not on the front before, too, by what their neighbours were like.
std::vector<FrontOpening> OpeningByPredictor::predict(const CrackState& crack) const {
  std::vector<FrontOpening> out(crack.points.size());
  struct Asked {
    std::size_t point;
    NodeId old;
  };
  std::vector<Asked> asked;
  SampleSet samples;
  const std::vector<FrontPast> pasts = front_pasts(crack, history());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    if (const FrontHistory::Entry* still = history().find(point.node)) {  // it did not move: nothing changes
      out[i].intensity = out[i].node_intensity = surroundings_ ? still->driving : still->intensity;
      continue;
    }
    out[i].known = false;
    if (!pasts[i].correlation && !surroundings_) continue;
    for (const NodeId old : pasts[i].nodes)
      if (auto sample = history().sample(crack, point, old)) {
        if (surroundings_) surroundings_->complete(crack, i, old, *sample);
        samples.add(*sample);
        asked.push_back({i, old});
      }
  }
  if (samples.empty()) return out;
  const std::vector<OpeningPrediction> predictions = predictor_.predict_openings(samples);
  for (std::size_t p = 0; p < predictions.size(); ++p) {
    const auto [i, old] = asked[p];
    const FrontOpening o = answer(crack.points[i], old, predictions[p]);
    out[i] = out[i].known ? mean(out[i], o) : o;
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
