#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Resultant of the surface tractions.
struct Resultant {
  Vec3 force;    ///< [N]
  Vec3 moment;   ///< about the centre of mass [N m]
  double scale;  ///< Σ |t| A [N]: what "small" is compared with
  Vec3 center;   ///< centre of mass of the (uniform) body [m]
};
Resultant resultant(const TriMesh& surface, const BoundaryData& data);

/// True when force and moment vanish relative to the loads applied (1e-6 of Σ|t|A, and of that times the
/// body's size).
bool balanced(const Resultant& r, const TriMesh& surface);

/// Inertia relief: the stress field that belongs to the rigid-body acceleration which the unbalanced load
/// causes. Body force b(x) = −ρ (a + α × (x − c)) with F = m a, T = I α; a polynomial field with
/// div σ + b = 0. The density cancels: only shape and load matter.                     docs/theory.md (B8)
AmbientField inertia_field(const TriMesh& surface, const Resultant& r, const ElasticConstants& m);

/// Orthonormal rigid motions, six for every connected part of the surface that touches no displacement
/// boundary, each 3·nodes long and zero off its part. They are the null space of the hypersingular operator:
/// a cavity's surface has its own six, which move nothing but itself.
std::vector<std::vector<double>> floating_motions(const TriMesh& surface,
                                                  const std::vector<BoundaryKind>& kinds);

}  // namespace conchoid
