#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// A number, or null where it is not finite (JSON knows no others).
inline nlohmann::ordered_json number(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json to_json(const Vec3& v) {
  return nlohmann::ordered_json::array({number(v.x()), number(v.y()), number(v.z())});
}

}  // namespace conchoid
