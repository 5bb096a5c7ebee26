#pragma once

#include <span>
#include <vector>

#include "conchoid/elastic/constants.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// A panel with the data it carries: traction t [Pa] (constant) and density w [m] at its corners (u on the
/// surface, −Δu on a crack).
struct LoadedPanel {
  Panel panel;
  Vec3 traction;
  std::array<Vec3, 3> density;
};

/// Stress at inner points by differentiating the representation formula (Somigliana's identity):
/// σ_ij(x) = ∫ D_kij(x,y) t_k(y) − ∫ S_kij(x,y) w_k(y)                                 docs/theory.md (T2)
/// Panels are halved until they are small against their distance from x; no point may lie on a panel.
std::vector<Mat3> interior_stress(std::span<const Vec3> points, const std::vector<LoadedPanel>& panels,
                                  const ElasticConstants& m);

/// The same with quadratic density (corners, then middles of the edges 01, 12, 20) and linear traction.
struct QuadraticLoadedPanel {
  Panel panel;
  std::array<Vec3, 3> traction;
  std::array<Vec3, 6> density;
};
Mat3 interior_stress(const Vec3& point, const std::vector<QuadraticLoadedPanel>& panels,
                     const ElasticConstants& m);

}  // namespace conchoid
