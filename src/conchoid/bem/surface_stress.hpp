#pragma once

#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Stress on a flat surface triangle from the displacement of its corners and the traction on it [Pa].
/// In the plane: σ_ab = 2μ (ε_ab + ν/(1−ν) ε_cc δ_ab) + ν/(1−ν) t_n δ_ab; out of it σ·n = t.
///                                                                                     docs/theory.md (T1)
/// @param u  corner displacements [m];  t  traction σ·n [Pa];  n from the corners' order
Mat3 surface_stress(const Triangle& x, const std::array<Vec3, 3>& u, const Vec3& t,
                    const ElasticConstants& m);

/// Strain of a stress by Hooke's law: ε = (σ − ν/(1+ν) tr σ · 1) / 2μ.
Mat3 strain_of(const Mat3& stress, const ElasticConstants& m);

/// Principal values, largest first, and the direction that belongs to each (columns; signs are the eigen
/// solver's).
struct PrincipalStress {
  Vec3 value;  ///< σ1 ≥ σ2 ≥ σ3 [Pa]
  Mat3 direction;
};
PrincipalStress principal_stress(const Mat3& stress);

}  // namespace conchoid
