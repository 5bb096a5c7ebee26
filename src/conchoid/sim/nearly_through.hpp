#pragma once

#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/sim/crack_state.hpp"

namespace conchoid {

/// Whether some crack has little left to break: ahead of each of its front points, within about `width`, there is
/// a face of a crack or of the body. What is left there is for the last ligament to tell; where it is false, no
/// ligament of that width completes a crack, as its front has farther to go.
/// @param surface  of the body, boundary elements; without triangles (infinite body) nothing but cracks is ahead
/// @param width    [m]
bool nearly_through(const CrackState& crack, const ClosestPointTree& surface, double width);

}  // namespace conchoid
