#pragma once

#include <unordered_map>
#include <vector>

#include "conchoid/sim/crack_state.hpp"

namespace conchoid {

/// What crosses a crack in the body without it, and the ligament that has to carry it instead.
///
/// F = ∫ σn dA over the crack and its moment. The ligament, of area A and centroid c, takes them over as between two rigid
/// halves:
///   t(x) = F/A + ω × (x − c),  ω = J⁻¹ M_c,  J = ∫ |y − c|² I − (y − c)(y − c)ᵀ dA
/// the bending (Navier) and twisting of a beam whose section it is: exact in the resultant however deep the crack. n is the
/// crack's normal, t the traction on planes with that normal.
struct NetSection {
  Vec3 force = Vec3::Zero();   ///< F [N]
  Vec3 moment = Vec3::Zero();  ///< M about the origin [N m]
  double front = 0;            ///< length of the crack's fronts inside [m]
  double ligament = 0;         ///< A [m²]; not finite in an infinite body, which takes over nothing
  Vec3 center = Vec3::Zero();  ///< c [m]
  Vec3 turn = Vec3::Zero();    ///< ω [Pa/m]

  Vec3 moment_about(const Vec3& x) const { return moment - cross(x, force); }
  Vec3 taken_over(const Vec3& x) const;  ///< t [Pa]
};

/// Per connected crack, numbered as by crack_sizes(). The ligament is what the edges of its fronts sweep straight ahead.
/// @param stress  σ of the uncracked body at nodes of the sheet [Pa]; a triangle has the mean of those of its nodes that
///                are there
/// @param ahead   per point of the crack, distance to the body's surface along e2 [m]; may be infinite
std::vector<NetSection> net_sections(const CrackState& crack, const std::unordered_map<NodeId, Mat3>& stress,
                                     const std::vector<double>& ahead);

/// Stress intensity K_I [Pa√m] of a crack whose two sides are beams of these heights [m], clamped at its front and bent open
/// by a moment [N m] on a front of that length [m]: √12 M/(b h^(3/2)), in the mean of both. 0 where there is no front.
double arm_intensity(double moment, double front, double above, double below);

}  // namespace conchoid
