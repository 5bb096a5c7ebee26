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

/// How the active set method ended.
struct ContactReport {
  int sweeps = 0;
  bool converged = true;
  double penetration = 0;      ///< largest that is left [m], ≥ 0
  double largest_opening = 0;  ///< of the solution without contact, any component [m]
};

constexpr int kContactSweeps = 60;

/// Minimises ½ xᵀSx − fᵀx under the constraints by an active set method, starting from x = S⁻¹f:
/// (G S⁻¹ Gᵀ) λ = −G S⁻¹ f on the active set, λ ≥ 0.                                    docs/theory.md (C1)
/// Converged when no opening is below −10⁻⁶ of the largest.
/// @param solve  applies S⁻¹ in place to `count` vectors
ContactReport close_penetrating_faces(std::vector<double>& x,
                                      const std::vector<OpeningConstraint>& constraints,
                                      const std::function<void(double*, std::size_t)>& solve,
                                      int most_sweeps = kContactSweeps);

/// What to tell the user when it did not converge.
std::string contact_warning(const ContactReport& report);

}  // namespace conchoid
