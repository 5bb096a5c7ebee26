#include "conchoid/bem/quadratic_stress.hpp"

#include "conchoid/bem/surface_stress.hpp"

namespace conchoid {

Mat3 surface_stress(const QuadraticSolution& solution, TriId triangle, const Vec3& l) {
  const QuadraticSpace& space = *solution.space;
  const Panel& panel = space.corners.panels[triangle.index()];
  const auto& nodes = space.nodes[triangle.index()];
  std::array<Vec3, 3> tangent;  // corner values of a linear function with the gradient at l: Σ u_k ∂φ_k/∂N_j
  Vec3 t = Vec3::Zero();
  for (int j = 0; j < 3; ++j) {
    const int before = (j + 2) % 3, after = (j + 1) % 3;
    const auto u = [&](int k) -> const Vec3& {
      return solution.displacement[nodes[static_cast<std::size_t>(k)]];
    };
    tangent[static_cast<std::size_t>(j)] =
        (4 * l[j] - 1) * u(j) + 4 * l[after] * u(3 + j) + 4 * l[before] * u(3 + before);
    t += l[j] * solution.traction[triangle.index()][static_cast<std::size_t>(j)];
  }
  Mat3 stress = surface_stress(panel.x, tangent, t, space.corners.m);
  if (solution.ambient.stress)
    stress += solution.ambient.stress(l[0] * panel.x[0] + l[1] * panel.x[1] + l[2] * panel.x[2]);
  return stress;
}

}  // namespace conchoid
