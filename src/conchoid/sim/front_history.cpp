#include "conchoid/sim/front_history.hpp"

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

const FrontHistory::Entry* FrontHistory::find(NodeId node) const {
  const auto found = entries_.find(node);
  return found == entries_.end() ? nullptr : &found->second;
}

bool FrontHistory::knows(const FrontPoint& point, NodeId old) const {
  if (!old.valid() || !(point.distance > 0)) return false;
  const Entry* before = find(old);
  return before && before->distance > 0;
}

std::optional<Sample> FrontHistory::sample(const CrackState& crack, const FrontPoint& point,
                                           NodeId old) const {
  if (!knows(point, old)) return {};
  const Entry* before = find(old);
  Sample s;
  s.frame = crack.sheet.frame + 1;
  s.node = old.value;
  s.front = point.front;
  s.K = before->intensity;
  s.toughness = material_.toughness * toughness_.at(crack.sheet.mesh.positions[old]).value;
  s.resolution = resolution_;
  s.distance_before = before->distance;
  s.distance_after = point.distance;
  s.travelled = crack.sheet.travelled[old];
  s.youngs_modulus = material_.youngs_modulus;
  s.poisson_ratio = material_.poisson_ratio;
  return s;
}

void FrontHistory::remember(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  last_.clear();
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontPoint& p = crack.points[i];
    if (!openings[i].known) continue;
    last_.push_back(p.node);
    entries_[p.node] = {p.frame, openings[i].node_intensity, p.distance, crack.sheet.frame,
                        openings[i].intensity};
  }
}

}  // namespace conchoid
