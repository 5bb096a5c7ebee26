#pragma once

#include <cstddef>

#include "conchoid/crack/front/front.hpp"

namespace conchoid {

/// Where a point behind the front belongs on it.
struct FrontFoot {
  std::size_t edge = 0;  ///< front edge: from node `edge` to the next one
  double fraction = 0;   ///< along that edge, 0…1
  double distance =
      0;  ///< r [m] from the point to the true front: to the chord, plus the chord's sagitta at the foot
  bool clipped =
      false;  ///< at an end of the range searched, beyond which the front goes on: the true foot is there
};

/// Edges of a front: `count` of them from edge `first` on, which may lie before the start. They go round a
/// closed front and are clipped at the ends of an open one.
struct EdgeRange {
  std::ptrdiff_t first = 0;
  std::size_t count = 1;
};

/// The `reach` edges on either side of front node i: the same ones whichever way the front is walked.
inline EdgeRange edges_around(std::size_t i, std::size_t reach) {
  return {static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(reach), 2 * reach};
}

/// Foot of x on the front edges in `range` closest to x.
/// A front edge is a chord of the true, smooth front, which lies outside it by κ s (L − s)/2 with the
/// curvature κ taken from the tangents at its two ends.
FrontFoot closest_foot(const TriMesh& crack, const Front& front, const Vec3& x, EdgeRange range);

/// Frame of the front at the foot.
FrontFrame frame_at(const Front& front, const FrontFoot& foot);

}  // namespace conchoid
