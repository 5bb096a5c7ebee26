#pragma once

#include "conchoid/crack/front.hpp"

namespace conchoid {

/// Where a point behind the front belongs on it.
struct FrontFoot {
  std::size_t edge = 0;  ///< front edge: from node `edge` to the next one
  double fraction = 0;   ///< along that edge, 0…1
  double distance =
      0;  ///< r [m] from the point to the true front: to the chord, plus the chord's sagitta at the foot
};

/// Foot of x on the front edges [first_edge − reach, first_edge + reach] (clipped at open ends) to x.
/// A front edge is a chord of the true, smooth front, which lies outside it by κ s (L − s)/2 with the
/// curvature κ taken from the tangents at its two ends.
FrontFoot closest_foot(const TriMesh& crack, const Front& front, const Vec3& x, std::size_t first_edge,
                       std::size_t reach);

/// Frame of the front at the foot.
FrontFrame frame_at(const Front& front, const FrontFoot& foot);

}  // namespace conchoid
