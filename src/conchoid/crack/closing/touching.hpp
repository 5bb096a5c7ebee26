#pragma once

#include <vector>

#include "conchoid/crack/front/sheet.hpp"

namespace conchoid {

/// A front node that is about to touch an edge of a front (see touching_nodes). It may lie outside of the body: the
/// ends of fronts that come round a hole must not pass each other in there.
struct FrontTouch {
  std::size_t front = 0, index = 0;  ///< the node: front of the sheet, place in it
  std::size_t other = 0, edge = 0;   ///< the edge: from place `edge` of front `other` to the next
  double gap = 0;                    ///< distance between the two now [m]
};

/// All of them, in order of (front, index, other, edge).
std::vector<FrontTouch> front_touches(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                      double target_edge);

/// Least distance of the segments pq and ab, which may be points (Ericson, Real-Time Collision Detection,
/// 5.1.9).
double segment_distance(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b);

}  // namespace conchoid
