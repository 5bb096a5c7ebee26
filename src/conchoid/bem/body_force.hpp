#pragma once

#include "conchoid/bem/rigid_body.hpp"

namespace conchoid {

/// Force per volume that is at most linear in space, about the centre of mass c of a uniform body, ξ = x − c:
///   b(x) = g + w × ξ + |s|² ξ − s (s·ξ)                                                  [N/m³]
/// g: weight, or a translation's inertia −ρ a · w: that of a rotation that changes its speed, −ρ α ·
/// s = √ρ ω: centrifugal, of a steady rotation ω about an axis through c.               docs/theory.md (B8)
struct BodyForce {
  Vec3 center = Vec3::Zero();   ///< c [m]
  Vec3 uniform = Vec3::Zero();  ///< g [N/m³]
  Vec3 turning = Vec3::Zero();  ///< w [N/m⁴]
  Vec3 spin = Vec3::Zero();     ///< s [√(kg/m³)/s]

  bool none() const { return uniform.isZero(0) && turning.isZero(0) && spin.isZero(0); }
};

/// The weight of a body, and what acts on it while it turns steadily.
/// @param center    of mass [m]
/// @param density   [kg/m³]
/// @param gravity   acceleration [m/s²]
/// @param omega     [rad/s]; @param on_axis  a point of the axis [m]
BodyForce weight_and_spin(const Vec3& center, double density, const Vec3& gravity, const Vec3& omega,
                          const Vec3& on_axis);

/// The inertia with which a free body follows a resultant: b = −ρ (a + α × ξ), F = m a, M = I α. The density
/// cancels: only shape and load matter.
/// @param r  about the centre of mass
BodyForce inertia_force(const TriMesh& surface, const Resultant& r);

/// A polynomial field with div σ + b = 0: what the elements then compute is a body without body force under the
/// rest of the surface's data. No volume is meshed. Chosen so that it is the whole solution of simple bodies:
/// g a column along g, s a thin disc across s, w without tension along the axis.       docs/theory.md (B8)
AmbientField particular_field(const BodyForce& force, const ElasticConstants& m);

/// The resultant with that of the body force, integrated exactly over the volume.
Resultant with_body_force(const TriMesh& surface, Resultant r, const BodyForce& force);

}  // namespace conchoid
