#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// One opening that must not become negative: normal · x[first … first+2] ≥ 0.
struct OpeningConstraint {
  std::size_t first;  ///< position of the opening's first component in x
  Vec3 normal;        ///< unit, of the crack at the node
};

/// How the search for the touching nodes ended.
struct ContactReport {
  int sweeps = 0;  ///< sets of touching nodes tried
  bool converged = true;
  double penetration = 0;      ///< largest that is left [m], ≥ 0
  double largest_opening = 0;  ///< of the solution without contact, any component [m]
};

/// A bound that is not reached: the search ends by itself.
constexpr int kContactSweeps = 2000;

/// Minimises ½ xᵀSx − fᵀx under the constraints, starting from x = S⁻¹f. With the compliance
/// C = G S⁻¹ Gᵀ of the constrained openings, symmetric positive definite, this is the linear complementarity
/// problem                                                                              docs/theory.md (C1)
///     w = G S⁻¹ f + C λ ,   w ≥ 0 ,   λ ≥ 0 ,   wᵀλ = 0        w: openings [m], λ: forces of the closed faces
/// Block principal pivoting: all nodes of the wrong sign, open with w < 0 or closed with λ < 0, change at once;
/// where that does not reduce their number a few times in a row only the last of them does (Murty's rule, which
/// ends on every such C) until it has (Júdice & Pires, Computers Ops. Res. 21, 1994). It cannot cycle.
/// Converged when no opening is below −10⁻⁶ of the largest and no closed face pulls.
/// @param solve  applies S⁻¹ in place to `count` vectors
ContactReport close_penetrating_faces(std::vector<double>& x,
                                      const std::vector<OpeningConstraint>& constraints,
                                      const std::function<void(double*, std::size_t)>& solve,
                                      int most_sweeps = kContactSweeps);

/// What to tell the user when it did not converge.
std::string contact_warning(const ContactReport& report);

}  // namespace conchoid
