#include "conchoid/sim/uncracked_stress.hpp"

#include <cmath>

namespace conchoid {
namespace {

constexpr double kDepth = 0.25;  // × r̄: nearer to the surface the stress is that of this depth

}  // namespace

UncrackedStress::UncrackedStress(const PreparedBody& body) : body_(body), surface_(body.surface) {}

std::vector<Mat3> UncrackedStress::at_points(std::vector<Vec3> at, const LoadCase& load,
                                             std::size_t version) {
  if (body_.infinite()) {
    std::vector<Mat3> stress;
    for (const Vec3& x : at)
      stress.push_back(load.ambient.stress(x));
    return stress;
  }
  const double depth = kDepth * body_.crack_edge;
  for (Vec3& x : at) {
    const ClosestPointTree::Hit hit = surface_.closest(x);
    const double distance = std::sqrt(hit.squared_distance);
    if (distance < depth && distance > 0) x = hit.point + depth / distance * (x - hit.point);
  }
  if (!uncracked_ || version_ != version) {
    uncracked_ = std::make_unique<CrackedBody>(body_.elastic, load);
    uncracked_->solve();
    version_ = version;
  }
  return uncracked_->interior_stress(at);
}

}  // namespace conchoid
