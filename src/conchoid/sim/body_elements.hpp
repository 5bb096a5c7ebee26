#pragma once

#include <string_view>

#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// Gives a prepared body the quadratic elements that run.elements asks for: "quadratic", or "auto" for a body with
/// walls too thin for linear ones (coarse_walls) of at most most_quadratic_elements triangles. An infinite body has
/// none. Errors:
/// ComputationError when the system is singular and "quadratic" was asked for; else a warning.
/// @param kinds  of the scene's conditions
void choose_elements(const RunSpec& run, const std::vector<BoundaryKind>& kinds, PreparedBody& body);

/// "linear" or "quadratic": what the uncracked body's stress comes from.
std::string_view elements_of(const PreparedBody& body);

/// The load as the body's elements take it (as_field() of quadratic ones).
LoadCase as_elements_take(LoadCase load, const PreparedBody& body);

}  // namespace conchoid
