#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

SifSettings sif_settings(const RunSpec& run) {
  SifSettings s;
  s.method = run.sif == SifSource::two_point ? SifMethod::two_point : SifMethod::one_point;
  s.convention = run.sif_convention == OpeningConvention::full ? SifConvention::full_opening
                                                               : SifConvention::half_opening;
  return s;
}

BemOpening::BemOpening(std::shared_ptr<const BodyOperator> body, LoadCase load, const SifSettings& sif)
    : body_(std::move(body), std::move(load)), m_(body_.body().material()), sif_(sif) {}

void BemOpening::solve(const CutComplex& cut, const CutDivision& division) {
  body_.set_crack(cut, division);
  body_.solve();
}

std::vector<FrontOpening> BemOpening::open(const CrackState& crack) {
  solve(crack.cut, crack.division);
  // Per node of the cut complex; zero at points that no front of the trimmed crack goes through.
  IdVector<NodeId, Vec3> intensity(crack.cut.positions.size(), Vec3::Zero());
  for (const Front& front : crack.fronts) {
    const std::vector<Vec3> K = stress_intensities(crack.trimmed, front, body_.opening(), m_, sif_);
    for (std::size_t i = 0; i < K.size(); ++i)
      intensity[front.nodes[i]] = K[i];
  }
  std::vector<FrontOpening> out;
  for (const FrontPoint& point : crack.points) {
    FrontOpening o;
    o.intensity = intensity[crack.node_in_cut[point.node]];
    const NodeId behind = point.correlation.valid() ? crack.node_in_cut[point.correlation] : NodeId{};
    o.node_intensity = o.intensity;
    if (behind.valid() && point.distance > 0) {
      o.opening = body_.opening()[behind];
      o.node_intensity = stress_intensity(
          {o.opening.dot(point.frame.e1), o.opening.dot(point.frame.e2), o.opening.dot(point.frame.e3)},
          point.distance, m_, sif_.convention);
      // The last ligaments at corners are too small to fit anything: the one opening there is has to do.
      if (o.intensity.isZero(0)) o.intensity = o.node_intensity;
    }
    out.push_back(o);
  }
  return out;
}

}  // namespace conchoid
