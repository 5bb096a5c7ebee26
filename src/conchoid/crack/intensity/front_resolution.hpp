#pragma once

#include <limits>
#include <vector>

#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// What may be done with K at a front point whose neighbours say otherwise.
struct FrontResolution {
  Vec3 intensity = Vec3::Zero();  ///< K smoothed as far as it is not resolved [Pa·√m]
  double step = 1;                ///< share of the law's step that it justifies, ≤ 1
  double turn = 1;                ///< share of the law's angle that it justifies, ≤ 1
  bool pressed = false;           ///< closed by pressure, which sliding does not overcome
  /// Length it moves at most in a frame [m]. @param resolution  r̄ [m]
  double limit(double resolution) const {
    return step < 1 ? step * resolution : std::numeric_limits<double>::infinity();
  }
};

/// Greatest hoop intensity over θ of (K_I, √(K_II² + K_III²/(1−ν))) with K_I < 0 as it is [Pa·√m], ≥ 0:
/// σ_θθ √(2πr) at the angle of hoop_intensity()'s maximum.
double greatest_hoop_intensity(const Vec3& K, const ElasticConstants& m);

/// K along a front as the elements resolve it. Coarse nodes are about r̄ apart, and no K of such a mesh
/// varies by its own size from one to the next: where it does, as under mixed and mostly compressive stress,
/// it is noise. With the change from node to node
///     u_ij = |K_i − K_j| / max(|K_i|, |K_j|, K_c) ,   |K|² = K_I² + K_II² + K_III²/(1−ν) ,   u_i = max_j u_ij
/// (j: the two neighbours; u > 1 takes an angle of 60° and more between the two)
///   - K is smoothed by (¼, ½, ¼), two passes, in full from u_i = 1¼ on, not at all below ¾: a front on which
///     K is smooth keeps its bits;
///   - where u_i is still above 1 the step is shortened, to a quarter at u_i = 2 (K reversed);
///   - the error of K is a share of the largest K along the front, and at least what smoothing took away; a K below
///     it tells no direction: the angle counts by min(1, |K_i| / max(kTellingShare max_j |K_j|, |ΔK_i|))²;
///   - a point under pressure, K_I < 0, is pressed unless sliding opens a kink against it: the greatest hoop
///     intensity of (K_I, √(K_II² + K_III²/(1−ν))) reaches K_c, and the second is no less than −K_I: closed faces cannot
///     pass through each other, so that K_I < 0 is what the fit makes of them, and its error. A front of closed faces
///     stays there.
/// @param K          in the frame of each node, in the order of the front [Pa·√m]
/// @param toughness  K_c at each node [Pa·√m]
/// @param closed     a ring
std::vector<FrontResolution> resolve_along_front(const std::vector<Vec3>& K,
                                                 const std::vector<double>& toughness, bool closed,
                                                 const ElasticConstants& m);

}  // namespace conchoid
