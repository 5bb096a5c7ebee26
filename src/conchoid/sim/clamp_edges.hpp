#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// An edge of the boundary elements along which the conditions change so that the elastic stress is singular there:
/// it grows without bound as the elements get smaller, and says nothing about the strength. So is the edge of a
/// clamp (everything held on one side, something free on the other), and that of any support on a smooth part of
/// the surface (less than 45° between its normals). A plane of symmetry that meets another face at an angle has none.
struct ClampEdge {
  Vec3 a, b;      ///< its ends, of the prepared body [m]
  TriId support;  ///< the triangle that holds more
};
std::vector<ClampEdge> clamp_edges(const PreparedBody& body);

/// The region that holds the nearest of these edges, if it is nearer to x than r̄ or its own length.
std::optional<std::string> clamp_near(const PreparedBody& body, const Vec3& x);

/// What is to be said about a crack that starts at x, if that is at such an edge.
std::optional<std::string> clamp_warning(const PreparedBody& body, const Vec3& x);

}  // namespace conchoid
