#pragma once

#include <string>

namespace conchoid {

/// Finest resolutions: a crack right across a body may have so many triangles. Of boundary elements, that is a
/// matrix of 90 GB; of the visible surface, 10 GB of pieces.
inline constexpr double most_crack_triangles = 1e5, most_surface_triangles = 2e7;

/// Throws InputError, with the number of triangles and the value that would do, where equilateral triangles of
/// an edge would be too many on an area.
/// @param key   "resolution.surface"
/// @param area  that a crack is sure to have if it goes across [m²]
void require_affordable(const std::string& where, const std::string& key, double edge, double area,
                        double most);

}  // namespace conchoid
