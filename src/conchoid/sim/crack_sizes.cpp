#include "conchoid/sim/crack_sizes.hpp"

#include <algorithm>

namespace conchoid {

std::vector<CrackSize> crack_sizes(const CrackState& crack) {
  const std::vector<int> part = connected_parts(crack.trimmed);
  std::vector<CrackSize> sizes(part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end()));
  for (std::size_t s = 0; s < sizes.size(); ++s)
    sizes[s].crack = static_cast<int>(s);
  for (std::size_t t = 0; t < crack.trimmed.triangle_count(); ++t)
    sizes[part[crack.trimmed.corners[TriId(t)][0].index()]].area +=
        area_vector(crack.trimmed, TriId(t)).norm();
  for (const Edge& edge : crack.cut.mouth)
    sizes[part[edge.a.index()]].at_surface = true;
  std::vector<CrackSize> of_points;
  for (const FrontPoint& point : crack.points) {
    const NodeId node = crack.node_in_cut[point.node];
    of_points.push_back(node.valid() ? sizes[part[node.index()]] : CrackSize{});
  }
  return of_points;
}

}  // namespace conchoid
