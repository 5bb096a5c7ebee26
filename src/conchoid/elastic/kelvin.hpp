#pragma once

#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Kelvin's solution: displacement at x due to a unit force at y, d = x − y, R = |d|.
/// U_ij = 1/(16π μ (1−ν) R) [ (3−4ν) δ_ij + R,i R,j ]                                  docs/theory.md (K1)
Mat3 kelvin_displacement(const Vec3& d, const ElasticConstants& m);

/// Stress [Pa] at x due to the force f [N] at y, d = y − x, r = |d|, e = d/r: Hooke's law on the derivatives
/// of (K1).
/// σ_ij = D_kij f_k ,  D_kij = 1/(8π(1−ν) r²) [ (1−2ν)(δ_ki e_j + δ_kj e_i − δ_ij e_k) + 3 e_i e_j e_k ]
///                                                                                     docs/theory.md (T2)
Mat3 kelvin_stress(const Vec3& d, const Vec3& force, const ElasticConstants& m);

/// Stress at x due to a displacement w across a surface element at y with unit normal n, per area of the
/// element [Pa/m²], d = y − x: S_kij w_k, from the second derivatives of (K1).
///                                                                                     docs/theory.md (T2)
Mat3 kelvin_dislocation_stress(const Vec3& d, const Vec3& n, const Vec3& w, const ElasticConstants& m);

}  // namespace conchoid
