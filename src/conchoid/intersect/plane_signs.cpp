#include "conchoid/intersect/plane_signs.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/intersect/expansion.hpp"

namespace conchoid {
int turn(const Vec3& a, const Vec3& b, const Vec3& c, Projection pr) {
  const double left = (b[pr.p] - a[pr.p]) * (c[pr.q] - a[pr.q]);
  const double right = (b[pr.q] - a[pr.q]) * (c[pr.p] - a[pr.p]);
  const double determinant = left - right;
  const double bound = (4 + 32 * unit_roundoff) * unit_roundoff * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  if (bound == 0) return 0;
  auto difference = [&](const Vec3& x, int k) { return Expansion::difference(x[k], a[k]); };
  return (difference(b, pr.p) * difference(c, pr.q) - difference(b, pr.q) * difference(c, pr.p)).sign();
}

bool between(const Vec3& x, const Vec3& a, const Vec3& b, Projection pr) {
  auto within = [&](int k) { return std::min(a[k], b[k]) <= x[k] && x[k] <= std::max(a[k], b[k]); };
  return within(pr.p) && within(pr.q);
}

bool coplanar_segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Projection pr) {
  const int c_side = turn(a, b, c, pr), d_side = turn(a, b, d, pr);
  const int a_side = turn(c, d, a, pr), b_side = turn(c, d, b, pr);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && between(c, a, b, pr)) || (d_side == 0 && between(d, a, b, pr)) ||
         (a_side == 0 && between(a, c, d, pr)) || (b_side == 0 && between(b, c, d, pr));
}

}  // namespace conchoid
