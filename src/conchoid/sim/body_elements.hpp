#pragma once

#include <string_view>

#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// Memory of the factors of so many quadratic elements, nothing of them held.
constexpr double quadratic_bytes(double triangles) {
  return 144 * triangles * triangles;
}

/// Triangles beyond which quadratic elements are not chosen by themselves: 2.3 GB.
inline constexpr std::size_t most_quadratic_elements = 4000;

/// Gives a prepared body the quadratic elements that run.elements asks for: "quadratic", or "auto" for a body with
/// walls too thin for linear ones (coarse_walls) of at most most_quadratic_elements triangles. An infinite body has
/// none. Errors: ComputationError when the system is singular and "quadratic" was asked for; else a warning. Errors: ComputationError when the system is singular and "quadratic" was asked for; else a warning.
void choose_elements(const RunSpec& run, PreparedBody& body);

/// "linear" or "quadratic": what the uncracked body's stress comes from.
std::string_view elements_of(const PreparedBody& body);

/// The load as the body's elements take it. With quadratic ones: their solution as a field in which cracks open
/// (field_of), and nothing else prescribed.
LoadCase as_elements_take(LoadCase load, const PreparedBody& body);

}  // namespace conchoid
