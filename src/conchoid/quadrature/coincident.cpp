#include <cmath>

#include "conchoid/quadrature/cases.hpp"

namespace conchoid {

/// ∫_X∫_X k = (4A²/3) Σ_e λ_e(corner opposite e) / L_e, λ_e the potential of edge e: (Q5) with a corner as c,
/// twice again along the opposite edge. For 1/R these are the logarithms of Eibert & Hansen, IEEE Trans.
/// Antennas Propag. 43, 1995.
Family coincident_single_layer(const Panel& x) {
  Family sum = Family::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = x.x[i], &b = x.x[(i + 1) % 3], &opposite = x.x[(i + 2) % 3];
    sum += line_single_layer(opposite, a, b) / (b - a).norm();
  }
  return (4 * x.area * x.area / 3) * sum;
}

}  // namespace conchoid
