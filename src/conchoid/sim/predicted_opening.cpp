#include "conchoid/learn/forest.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {
namespace {

Vec3 in_frame(const FrontFrame& f, const Vec3& v) {
  return {v.dot(f.e1), v.dot(f.e2), v.dot(f.e3)};
}

// Points without a prediction of their own (their correlation node was not on the front) take the mean K of
// the nearest points of the same front that have one.
void fill_gaps(const CrackState& crack, const std::vector<char>& known, std::vector<FrontOpening>& out) {
  const std::size_t n = out.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (known[i]) continue;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (std::size_t step = 1; step < n && count == 0; ++step)
      for (std::size_t j : {i + step, i + n - step}) {
        const std::size_t k = j % n;
        if (!known[k] || crack.points[k].front != crack.points[i].front) continue;
        sum += out[k].intensity;
        ++count;
      }
    if (count > 0) out[i].intensity = out[i].node_intensity = sum / count;
  }
}

class SteadyOpening : public PredictedOpening {
 public:
  using PredictedOpening::PredictedOpening;
  std::string name() const override { return "steady"; }

 protected:
  std::vector<Guess> predict(const SampleSet& samples) override {
    std::vector<Guess> out;
    for (std::size_t i = 0; i < samples.size(); ++i)
      out.push_back({steady_opening(samples[i]), true});
    return out;
  }
};

class ForestOpening : public PredictedOpening {
 public:
  ForestOpening(BemOpening& first, const RegressionForest& forest, const MaterialSpec& material,
                const PreparedBody& body, const SifSettings& sif)
      : PredictedOpening(first, material, body, sif), forest_(forest) {}
  std::string name() const override { return "forest"; }

 protected:
  std::vector<Guess> predict(const SampleSet& samples) override {
    std::vector<Guess> out;
    for (const OpeningPrediction& p : forest_.predict_openings(samples))
      out.push_back({p.opening, p.in_range});
    return out;
  }

 private:
  const RegressionForest& forest_;
};

}  // namespace

std::vector<FrontOpening> PredictedOpening::open(const CrackState& crack) {
  std::vector<FrontOpening> out;
  if (crack.sheet.frame == 0) {
    out = first_.open(crack);
    history_.remember(crack, out);
    return out;
  }
  out.resize(crack.points.size());
  std::vector<char> known(out.size(), 0);
  SampleSet samples;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    if (const FrontHistory::Entry* still = history_.find(point.node)) {  // it did not move: nothing changes
      out[i].intensity = out[i].node_intensity = still->intensity;
      known[i] = 1;
    } else if (const auto sample = history_.sample(crack, point)) {
      samples.add(*sample);
      asked.push_back(i);
    }
  }
  const std::vector<Guess> guesses = samples.empty() ? std::vector<Guess>{} : predict(samples);
  for (std::size_t g = 0; g < guesses.size(); ++g) {
    const std::size_t i = asked[g];
    const FrontPoint& point = crack.points[i];
    const FrontFrame& before = history_.find(point.correlation)->frame;
    const Vec3& du = guesses[g].opening;
    FrontOpening& o = out[i];
    o.opening = du[0] * before.e1 + du[1] * before.e2 + du[2] * before.e3;
    const Sample s = samples[g];
    const ElasticConstants m{s.youngs_modulus, s.poisson_ratio};
    o.intensity = o.node_intensity =
        stress_intensity(in_frame(point.frame, o.opening), point.distance, m, sif_.convention);
    o.in_range = guesses[g].in_range;
    known[i] = 1;
  }
  fill_gaps(crack, known, out);
  history_.remember(crack, out);
  return out;
}

std::vector<FrontOpening> carried_openings(const CrackState& crack, const FrontHistory& history,
                                           const GrowthLaw& law) {
  std::vector<FrontOpening> out(crack.points.size());
  std::vector<char> known(out.size(), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontHistory::Entry* last = history.find(point.node);
    if (!last && point.correlation.valid()) last = history.find(point.correlation);
    if (!last) continue;
    known[i] = 1;
    out[i].intensity = out[i].node_intensity = law.drive(last->intensity) * Vec3::UnitX();
  }
  fill_gaps(crack, known, out);
  return out;
}

std::unique_ptr<OpeningSource> make_steady_opening(BemOpening& first, const MaterialSpec& material,
                                                   const PreparedBody& body, const SifSettings& sif) {
  return std::make_unique<SteadyOpening>(first, material, body, sif);
}

std::unique_ptr<OpeningSource> make_forest_opening(BemOpening& first, const RegressionForest& forest,
                                                   const MaterialSpec& material, const PreparedBody& body,
                                                   const SifSettings& sif) {
  return std::make_unique<ForestOpening>(first, forest, material, body, sif);
}

}  // namespace conchoid
