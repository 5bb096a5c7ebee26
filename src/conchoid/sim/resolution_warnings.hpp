#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/sim/crack_state.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

// What meshes are too coarse for, with the value that would do. Nothing of it changes a result. Bounds, and what they
// were measured on: docs/verification.md.

/// Boundary elements against the thickness of walls (remesh/wall_resolution.hpp).
std::vector<std::string> element_warnings(const PreparedBody& body);

/// Boundary elements that are slimmer or stouter than the body they stand for, by a quarter of its thickness, where a crack
/// starts: its stress is not the body's.
/// @param x  of the prepared body [m]
std::optional<std::string> outline_warning(const PreparedBody& body, const Vec3& x);

/// These, and the crack edge against thickness, radius of holes and depth of the cracks: r̄ up to half the thickness, up
/// to half the radius; cracks of at least two rows of triangles.
/// @param crack    as it stands
/// @param growing  new cracks may start
std::vector<std::string> resolution_warnings(const PreparedBody& body, const CrackState& crack, bool growing);

}  // namespace conchoid
