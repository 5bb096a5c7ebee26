#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Of the body that a closed surface bounds.
struct VolumeMoments {
  double volume = 0;            ///< [m³]
  Vec3 center = Vec3::Zero();   ///< of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre, for density 1 [m⁵]
};
VolumeMoments volume_moments(const TriMesh& surface);

/// A motion x ↦ v + ω × (x − c) about a centre c that its user knows.
struct RigidMotion {
  Vec3 v;      ///< [m]
  Vec3 omega;  ///< [rad]
};

/// Resultant of the prescribed surface tractions.
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

/// Basis of the rigid motions, about `center`, that the supports of one body leave it: none if it is held, three
/// translations and three rotations if it is free. What its cavities' surfaces hold counts, too.
std::vector<RigidMotion> free_motions(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                                      const Vec3& center);

/// What of a resultant moves a body in its free motions r: the force and moment of the body force with which the
/// body follows it, F = M r y with (rᵀ M r) y = rᵀ F, M the body's mass and inertia. The whole of it where nothing
/// is held, zero where everything is; the supports take the rest.
/// @param motions  free_motions() about r.center
Resultant unsupported(const TriMesh& surface, const Resultant& r, const std::vector<RigidMotion>& motions);

/// Orthonormal rigid motions of every connected part of the surface, as far as its supports leave them: six for a
/// part that nothing holds. Each is 3·nodes long and zero off its part. They are the null space of the system:
/// a cavity's surface has its own six, which move nothing but itself.                  docs/theory.md (B9)
std::vector<std::vector<double>> floating_motions(const TriMesh& surface,
                                                  const std::vector<BoundaryKind>& kinds);

}  // namespace conchoid
