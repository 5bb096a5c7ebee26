#include "conchoid/bem/rigid_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "conchoid/bem/pair_blocks.hpp"

namespace conchoid {
namespace {

struct MassProperties {
  double volume = 0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  // about the centre, for density 1
};

// Tetrahedra from a point near the body to every triangle.
MassProperties mass_properties(const TriMesh& surface) {
  MassProperties p;
  const Vec3 origin = bounding_box(surface).center();
  Mat3 second = Mat3::Zero();  // ∫ x xᵀ
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Triangle x = surface.triangle(TriId(t));
    const Vec3 a = x[0] - origin, b = x[1] - origin, c = x[2] - origin;
    const double volume = a.dot(cross(b, c)) / 6;
    const Vec3 s = a + b + c;
    p.volume += volume;
    p.center += volume / 4 * s;
    second += volume / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  p.center /= p.volume;
  second -= p.volume * p.center * p.center.transpose();
  p.inertia = second.trace() * Mat3::Identity() - second;
  p.center += origin;
  return p;
}

}  // namespace

Resultant resultant(const TriMesh& surface, const BoundaryData& data) {
  Resultant r{Vec3::Zero(), Vec3::Zero(), 0, mass_properties(surface).center};
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    if (data.kind[t] != BoundaryKind::traction) continue;
    const Vec3 f = area_vector(surface, TriId(t)).norm() * data.traction[t];
    r.force += f;
    r.moment += cross(centroid(surface, TriId(t)) - r.center, f);
    r.scale += f.norm();
  }
  return r;
}

bool balanced(const Resultant& r, const TriMesh& surface) {
  const double tolerance = 1e-6 * r.scale;
  return r.force.norm() <= tolerance && r.moment.norm() <= tolerance * bounding_box(surface).diagonal();
}

AmbientField inertia_field(const TriMesh& surface, const Resultant& r, const ElasticConstants& m) {
  const MassProperties p = mass_properties(surface);
  const Vec3 b = -r.force / p.volume;                            // −ρ a
  const Mat3 w = -cross_matrix(p.inertia.inverse() * r.moment);  // −ρ α×
  const double mu = m.shear_modulus();
  const double lambda = 2 * mu * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
  const double translation = -1 / (8 * mu + 2 * lambda), rotation = -1 / (10 * mu);
  const Vec3 center = p.center;
  AmbientField field;
  field.displacement = [=](const Vec3& y) -> Vec3 {
    const Vec3 x = y - center;
    return (translation * b + rotation * (w * x)) * x.squaredNorm();
  };
  field.stress = [=](const Vec3& y) -> Mat3 {
    const Vec3 x = y - center;
    const Mat3 gradient =
        2 * (translation * b + rotation * (w * x)) * x.transpose() + rotation * x.squaredNorm() * w;
    return lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
  };
  return field;
}

namespace {

// Six orthonormal motions of the given nodes.
void add_motions(const TriMesh& surface, const std::vector<std::size_t>& nodes,
                 std::vector<std::vector<double>>& out) {
  Vec3 center = Vec3::Zero();
  for (std::size_t i : nodes)
    center += surface.positions[NodeId(i)] / static_cast<double>(nodes.size());
  std::vector<std::vector<double>> modes(6, std::vector<double>(3 * surface.node_count(), 0.0));
  for (std::size_t i : nodes)
    for (int k = 0; k < 3; ++k) {
      const Vec3 rotation = cross(Vec3::Unit(k), surface.positions[NodeId(i)] - center);
      for (int j = 0; j < 3; ++j) {
        modes[k][3 * i + j] = j == k;
        modes[3 + k][3 * i + j] = rotation[j];
      }
    }
  for (std::size_t k = 0; k < 6; ++k)  // modified Gram–Schmidt
    for (std::size_t j = 0; j <= k; ++j) {
      const double product = std::inner_product(modes[k].begin(), modes[k].end(), modes[j].begin(), 0.0);
      const double length = std::sqrt(product);
      for (std::size_t i = 0; i < modes[k].size(); ++i)
        modes[k][i] = j == k ? modes[k][i] / length : modes[k][i] - product * modes[j][i];
    }
  for (auto& mode : modes)
    out.push_back(std::move(mode));
}

}  // namespace

std::vector<std::vector<double>> floating_motions(const TriMesh& surface,
                                                  const std::vector<BoundaryKind>& kinds) {
  const std::vector<int> part = connected_parts(surface);
  std::vector<std::vector<std::size_t>> nodes;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (static_cast<std::size_t>(part[i]) >= nodes.size()) nodes.emplace_back();
    nodes[part[i]].push_back(i);
  }
  std::vector<char> held(nodes.size(), 0);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (kinds[t] == BoundaryKind::displacement) held[part[surface.corners[TriId(t)][0].index()]] = 1;
  std::vector<std::vector<double>> modes;
  for (std::size_t p = 0; p < nodes.size(); ++p)
    if (!held[p]) add_motions(surface, nodes[p], modes);
  return modes;
}

}  // namespace conchoid
