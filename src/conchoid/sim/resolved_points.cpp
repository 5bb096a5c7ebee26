#include "conchoid/sim/resolved_points.hpp"

namespace conchoid {

std::vector<FrontResolution> resolve_points(const CrackState& crack,
                                            const std::vector<FrontOpening>& openings,
                                            const ToughnessField& toughness, const ElasticConstants& m) {
  std::vector<FrontResolution> out;
  for (const FrontOpening& opening : openings)
    out.push_back({opening.intensity});
  for (const PointChain& chain : point_chains(crack)) {
    std::vector<Vec3> K;
    std::vector<double> K_c;
    for (const std::size_t point : chain.points) {
      K.push_back(openings[point].intensity);
      K_c.push_back(toughness(crack.sheet.mesh.positions[crack.points[point].node]).value);
    }
    const std::vector<FrontResolution> resolved = resolve_along_front(K, K_c, chain.closed, m);
    for (std::size_t i = 0; i < resolved.size(); ++i)
      out[chain.points[i]] = resolved[i];
  }
  return out;
}

}  // namespace conchoid
