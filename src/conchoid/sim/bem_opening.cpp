#include <unordered_map>

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

SifSettings sif_settings(const RunSpec& run) {
  SifSettings s;
  s.method = run.sif == SifSource::two_point ? SifMethod::two_point : SifMethod::one_point;
  s.convention = run.sif_convention == OpeningConvention::full ? SifConvention::full_opening
                                                               : SifConvention::half_opening;
  return s;
}

BemOpening::BemOpening(const PreparedBody& body, const BodyLoad& load, const RunSpec& run)
    : body_(body.surface, load.data, body.material.elastic(), load.ambient,
            {run.quadrature_tolerance, run.contact}),
      m_(body.material.elastic()),
      sif_(sif_settings(run)) {}

void BemOpening::solve(const CutComplex& cut) {
  body_.set_crack(cut);
  body_.solve();
}

std::vector<FrontOpening> BemOpening::open(const CrackState& crack) {
  solve(crack.cut);
  std::unordered_map<NodeId, Vec3> intensity;  // per node of the cut complex
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
