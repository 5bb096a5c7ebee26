#pragma once

#include <functional>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// One opening that must not become negative: normal · x[first … first+2] ≥ 0.
struct OpeningConstraint {
  std::size_t first;  ///< position of the opening's first component in x
  Vec3 normal;        ///< unit, of the crack at the node
};

/// Minimises ½ xᵀPx − fᵀx under the constraints by an active set method, starting from x = P⁻¹f:
/// (G P⁻¹ Gᵀ) λ = −G P⁻¹ f on the active set, λ ≥ 0.                                    docs/theory.md (C1)
/// @param solve  applies P⁻¹ in place to `count` vectors
void close_penetrating_faces(std::vector<double>& x, const std::vector<OpeningConstraint>& constraints,
                             const std::function<void(double*, std::size_t)>& solve);

}  // namespace conchoid
