#include "conchoid/sim/nearly_through.hpp"

#include <array>

namespace conchoid {
namespace {

constexpr std::array<double, 2> kProbes{0.3, 0.6};  // × width ahead of the front
constexpr double kReach = 0.85;                     // × the same, about a probe: short of the front itself

}  // namespace

bool nearly_through(const CrackState& crack, const ClosestPointTree& surface, double width) {
  const ClosestPointTree faces(crack.trimmed);
  const auto near_wall = [&](const FrontPoint& point) {
    for (const double share : kProbes) {
      const double reach = share * width;
      const Vec3 probe = crack.sheet.mesh.positions[point.node] + reach * point.frame.e2;
      const double near = kReach * kReach * reach * reach;
      if (surface.closest(probe).squared_distance < near || faces.closest(probe).squared_distance < near)
        return true;
    }
    return false;
  };
  const std::vector<int> part = connected_parts(crack.sheet.mesh);
  std::vector<bool> has_points(part.size(), false), far(part.size(), false);
  for (const FrontPoint& point : crack.points) {
    const std::size_t p = static_cast<std::size_t>(part[point.node.index()]);
    has_points[p] = true;
    if (!far[p]) far[p] = !near_wall(point);
  }
  for (std::size_t p = 0; p < part.size(); ++p)
    if (has_points[p] && !far[p]) return true;
  return false;
}

}  // namespace conchoid
