#include "conchoid/mesh/winding_number.hpp"

#include <cmath>
#include <numbers>

namespace conchoid {

double winding_number(const TriMesh& surface, const Vec3& x) {
  double angle = 0;  // half of it
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Triangle triangle = surface.triangle(TriId(t));
    const Vec3 a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += std::atan2(a.dot(cross(b, c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (2 * std::numbers::pi);
}

}  // namespace conchoid
