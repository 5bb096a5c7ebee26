#pragma once

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Two coordinates of points in a common plane that keep that plane from collapsing.
struct Projection {
  int p, q;
};

/// Sign of the area of abc in the projection. Exact.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, Projection pr);

/// x on the line ab: whether between them.
bool between(const Vec3& x, const Vec3& a, const Vec3& b, Projection pr);

/// Whether the segments ab and cd have a point in common. Exact.
bool coplanar_segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Projection pr);

}  // namespace conchoid
