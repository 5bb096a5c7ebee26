#pragma once

#include <memory>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/sim/crack_state.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// Stress of a body as if it had no cracks, at the points of their fronts. The body is solved once per load; then
/// each point costs an integral over its surface.
class UncrackedStress {
 public:
  /// @param body  must outlive the object
  explicit UncrackedStress(const PreparedBody& body);

  /// σ [Pa] at points of the body, in the body's axes. Nearer to the surface than r̄/4 it is that of this depth.
  /// @param load     that acts; @param version  another one where the load is another
  std::vector<Mat3> at_points(std::vector<Vec3> at, const LoadCase& load, std::size_t version);

  const ClosestPointTree& surface() const { return surface_; }

 private:
  const PreparedBody& body_;
  ClosestPointTree surface_;
  std::unique_ptr<CrackedBody> uncracked_;  // under the load of that version
  std::size_t version_ = 0;
};

}  // namespace conchoid
