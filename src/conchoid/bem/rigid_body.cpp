#include "conchoid/bem/rigid_body.hpp"

#include <Eigen/LU>
#include <cmath>

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
  const Vec3 b = -r.force / p.volume;                                      // −ρ a
  const Mat3 w = -cross_matrix(p.inertia.inverse() * r.moment);            // −ρ α×
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
    const Mat3 gradient = 2 * (translation * b + rotation * (w * x)) * x.transpose() +
                          rotation * x.squaredNorm() * w;
    return lambda * gradient.trace() * Mat3::Identity() + mu * (gradient + gradient.transpose());
  };
  return field;
}

std::vector<std::vector<double>> rigid_motions(const TriMesh& surface) {
  const std::size_t n = surface.node_count();
  Vec3 center = Vec3::Zero();
  for (const Vec3& x : surface.positions)
    center += x / static_cast<double>(n);
  std::vector<std::vector<double>> modes(6, std::vector<double>(3 * n));
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 rotation = cross(Vec3::Unit(k), surface.positions[NodeId(i)] - center);
      for (int j = 0; j < 3; ++j) {
        modes[k][3 * i + j] = j == k;
        modes[3 + k][3 * i + j] = rotation[j];
      }
    }
  for (std::size_t k = 0; k < 6; ++k)      // modified Gram–Schmidt
    for (std::size_t j = 0; j <= k; ++j) {
      double product = 0;
      for (std::size_t i = 0; i < 3 * n; ++i)
        product += modes[k][i] * modes[j][i];
      const double length = j == k ? std::sqrt(product) : 1;
      for (std::size_t i = 0; i < 3 * n; ++i)
        modes[k][i] = j == k ? modes[k][i] / length : modes[k][i] - product * modes[j][i];
    }
  return modes;
}

}  // namespace conchoid
