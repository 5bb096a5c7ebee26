#pragma once

#include <Eigen/Core>
#include <array>

namespace conchoid {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Corners of a flat triangle, counter-clockwise seen from the side its normal points to.
using Triangle = std::array<Vec3, 3>;

/// Cross product written out, so that no heavier Eigen header is needed.
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// Twice the area times the unit normal: (b−a) × (c−a).
inline Vec3 area_vector2(const Vec3& a, const Vec3& b, const Vec3& c) {
  return cross(b - a, c - a);
}

}  // namespace conchoid
