#include "conchoid/sim/region_reach.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace conchoid {

std::string reach_text(const RegionRule& rule, const TriMesh& surface) {
  std::string text;
  for (const HalfSpace& half_space : rule.half_spaces) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& x : surface.positions) {
      low = std::min(low, half_space.normal.dot(x));
      high = std::max(high, half_space.normal.dot(x));
    }
    const Vec3& n = half_space.normal;
    text += fmt::format(
        "{}along ({:g}, {:g}, {:g}) the body reaches from {:.6g} to {:.6g}, the half space begins "
        "at {:.6g}",
        text.empty() ? "" : "; ", n.x(), n.y(), n.z(), low, high, half_space.offset);
  }
  return text;
}

}  // namespace conchoid
