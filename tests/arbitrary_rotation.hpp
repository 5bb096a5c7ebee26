#pragma once

#include "conchoid/core/vec.hpp"

namespace conchoid::test {

/// A rotation about no axis of note, orthogonal to the last bit or two.
inline Mat3 arbitrary_rotation() {
  const Vec3 a = Vec3(0.37, -0.61, 0.83).normalized();
  const Vec3 b = cross(a, Vec3(0.2, 0.9, 0.4)).normalized();
  Mat3 rotation;
  rotation << a, b, cross(a, b);
  return rotation;
}

}  // namespace conchoid::test
