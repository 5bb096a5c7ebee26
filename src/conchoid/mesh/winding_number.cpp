#include "conchoid/mesh/winding_number.hpp"

#include <cmath>
#include <numbers>

namespace conchoid {

namespace {

// A sum of angles: small ones by their tangents, as the argument of a product of complex numbers, so that few arc
// tangents are taken.
class Angles {
 public:
  // The argument of x + i y.
  void add(double y, double x) {
    constexpr double small = 0.1;
    if (!(std::abs(y) < small * x)) {
      sum_ += std::atan2(y, x);
      return;
    }
    const double tangent = y / x, re = re_ - im_ * tangent;
    im_ += re_ * tangent;
    re_ = re;
    constexpr double large = 1e100;
    if (!(std::abs(im_) < re_ && re_ < large)) {
      sum_ += std::atan2(im_, re_);
      re_ = 1;
      im_ = 0;
    }
  }
  double sum() const { return sum_ + std::atan2(im_, re_); }

 private:
  double sum_ = 0, re_ = 1, im_ = 0;
};

}  // namespace

double winding_number(const TriMesh& surface, const Vec3& x) {
  Angles half;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Triangle triangle = surface.triangle(TriId(t));
    const Vec3 a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half.add(a.dot(cross(b, c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half.sum() / (2 * std::numbers::pi);
}

}  // namespace conchoid
