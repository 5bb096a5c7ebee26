#pragma once

#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Kelvin's solution: displacement at x due to a unit force at y, d = x − y.
/// U_ij = 1/(16π μ (1−ν) R) [ (3−4ν) δ_ij + R,i R,j ]                                    docs/theory.md (K1)
Mat3 kelvin_displacement(const Vec3& d, const ElasticConstants& m);

}  // namespace conchoid
