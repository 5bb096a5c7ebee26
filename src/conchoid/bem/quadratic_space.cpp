#include "conchoid/bem/quadratic_space.hpp"

#include <algorithm>

namespace conchoid {

QuadraticSpace::QuadraticSpace(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                               double quadrature_tolerance)
    : corners(std::move(surface), std::move(kinds), m, quadrature_tolerance),
      integrator(quadrature_tolerance) {
  const TriMesh& mesh = corners.surface;
  held = held_at_nodes(mesh, corners.kinds);
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    positions.push_back(mesh.positions[NodeId(i)]);
    ends.push_back({i, i});
  }
  std::vector<std::array<std::size_t, 2>> edges;
  const auto edge = [&](std::size_t t, int k) {
    const auto& c = mesh.corners[TriId(t)];
    const std::size_t a = c[k].index(), b = c[(k + 1) % 3].index();
    return std::array{std::min(a, b), std::max(a, b)};
  };
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      edges.push_back(edge(t, k));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& e : edges) {
    positions.push_back(0.5 * (mesh.positions[NodeId(e[0])] + mesh.positions[NodeId(e[1])]));
    ends.push_back(e);
    held.push_back(Mat3::Zero());
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::size_t, 6> of_panel;
    for (int k = 0; k < 3; ++k) {
      of_panel[static_cast<std::size_t>(k)] = mesh.corners[TriId(t)][k].index();
      const auto at = std::lower_bound(edges.begin(), edges.end(), edge(t, k));
      const std::size_t middle = mesh.node_count() + static_cast<std::size_t>(at - edges.begin());
      of_panel[static_cast<std::size_t>(3 + k)] = middle;
      if (!corners.kinds[t].holds_nothing()) held[middle] = join_held(held[middle], corners.kinds[t].held());
    }
    nodes.push_back(of_panel);
  }
  unknown.assign(positions.size(), -1);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (held[i].isIdentity(0)) continue;
    unknown[i] = static_cast<int>(free_nodes.size());
    free_nodes.push_back(i);
    unknown_part.push_back(Mat3::Identity() - held[i]);
  }
}

std::vector<double> QuadraticSpace::on_free_nodes(const std::vector<double>& of_corners) const {
  std::vector<double> out;
  for (const std::size_t node : free_nodes)
    for (std::size_t p = 0; p < 3; ++p)
      out.push_back(0.5 * (of_corners[3 * ends[node][0] + p] + of_corners[3 * ends[node][1] + p]));
  return out;
}

QuadraticData::QuadraticData(const QuadraticSpace& space, const LoadCase& load) {
  const AmbientField& ambient = load.ambient;
  for (std::size_t t = 0; t < space.nodes.size(); ++t) {
    const Panel& panel = space.corners.panels[t];
    const Mat3 free = Mat3::Identity() - space.corners.kinds[t].held();
    std::array<Vec3, 3> at, middle = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    if (ambient.stress)
      for (int k = 0; k < 3; ++k)
        middle[k] = free * (ambient.stress(0.5 * (panel.x[k] + panel.x[(k + 1) % 3])) * panel.normal);
    // In place of its mean, which was taken off, the linear traction that is that of the field in the middles.
    const Vec3 mean = (middle[0] + middle[1] + middle[2]) / 3;
    for (int k = 0; k < 3; ++k)
      at[k] = load.traction[t] + mean - (middle[k] + middle[(k + 2) % 3] - middle[(k + 1) % 3]);
    traction.push_back(at);
  }
  for (std::size_t i = 0; i < space.positions.size(); ++i) {
    const auto [a, b] = space.ends[i];
    if (a == b) {
      displacement.push_back(load.displacement[NodeId(i)]);
      continue;
    }
    Vec3 u = 0.5 * (load.displacement[NodeId(a)] + load.displacement[NodeId(b)]);
    if (ambient.displacement)
      u += 0.5 * (ambient.displacement(space.positions[a]) + ambient.displacement(space.positions[b])) -
           ambient.displacement(space.positions[i]);
    displacement.push_back(space.held[i] * u);
  }
}

}  // namespace conchoid
