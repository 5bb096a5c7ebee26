#include "conchoid/bem/rigid_body.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "conchoid/bem/load_case.hpp"
#include "conchoid/bem/pair_blocks.hpp"

namespace conchoid {
// Tetrahedra from a point near the body to every triangle.
VolumeMoments volume_moments(const TriMesh& surface) {
  VolumeMoments p;
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

Resultant resultant(const TriMesh& surface, const BoundaryData& data) {
  Resultant r{Vec3::Zero(), Vec3::Zero(), 0, volume_moments(surface).center};
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    if (data.kind[t].holds_all()) continue;
    Vec3 f = area_vector(surface, TriId(t)).norm() * data.traction[t];
    if (!data.kind[t].holds_nothing()) f -= data.kind[t].held() * f;
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

namespace {

// Displacement of x under the six unit motions about a centre, three translations and three rotations.
Eigen::Matrix<double, 3, 6> unit_motions(const Vec3& x, const Vec3& center) {
  Eigen::Matrix<double, 3, 6> B;
  B << Mat3::Identity(), -cross_matrix(x - center);
  return B;
}

std::vector<RigidMotion> all_motions() {
  std::vector<RigidMotion> motions;
  for (int k = 0; k < 6; ++k)
    motions.push_back({k < 3 ? Vec3(Vec3::Unit(k)) : Vec3(Vec3::Zero()),
                       k < 3 ? Vec3(Vec3::Zero()) : Vec3(Vec3::Unit(k - 3))});
  return motions;
}

// Motions that no hold sees: the null space of Σ Bᵀ H B, with rotations measured at the size of the body.
std::vector<RigidMotion> motions_left(const TriMesh& surface, const std::vector<Mat3>& held,
                                      const std::vector<char>& counts, const Vec3& center, double size) {
  constexpr double unseen = 1e-11;  // of the largest eigenvalue
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  Mat6 seen = Mat6::Zero();
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!counts[i] || held[i].isZero(0)) continue;
    Eigen::Matrix<double, 3, 6> B = unit_motions(surface.positions[NodeId(i)], center);
    B.rightCols<3>() /= size;
    seen += B.transpose() * held[i] * B;
  }
  if (seen.isZero(0)) return all_motions();
  const Eigen::SelfAdjointEigenSolver<Mat6> eigen(seen);
  std::vector<RigidMotion> motions;
  for (int k = 0; k < 6; ++k)
    if (eigen.eigenvalues()[k] <= unseen * eigen.eigenvalues()[5])
      motions.push_back(
          {eigen.eigenvectors().col(k).head<3>(), eigen.eigenvectors().col(k).tail<3>() / size});
  return motions;
}

// Volume that each connected part of a closed surface encloses; negative: a cavity.
std::vector<double> volume_of_parts(const TriMesh& surface, const std::vector<int>& part) {
  std::vector<double> volume;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const auto p = static_cast<std::size_t>(part[surface.corners[TriId(t)][0].index()]);
    if (p >= volume.size()) volume.resize(p + 1, 0.0);
    const Triangle x = surface.triangle(TriId(t));
    volume[p] += x[0].dot(cross(x[1], x[2])) / 6;
  }
  return volume;
}

// Orthonormal vectors, one per motion, of the given nodes.
void add_motions(const TriMesh& surface, const std::vector<std::size_t>& nodes, const Vec3& center,
                 const std::vector<RigidMotion>& motions, std::vector<std::vector<double>>& out) {
  std::vector<std::vector<double>> modes(motions.size(), std::vector<double>(3 * surface.node_count(), 0.0));
  for (std::size_t i : nodes)
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const Vec3 moved = motions[k].v + cross(motions[k].omega, surface.positions[NodeId(i)] - center);
      std::copy_n(moved.data(), 3, &modes[k][3 * i]);
    }
  for (std::size_t k = 0; k < modes.size(); ++k)  // modified Gram–Schmidt
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

std::vector<RigidMotion> free_motions(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                                      const Vec3& center) {
  return motions_left(surface, held_at_nodes(surface, kinds), std::vector<char>(surface.node_count(), 1),
                      center, bounding_box(surface).diagonal());
}

Resultant unsupported(const TriMesh& surface, const Resultant& r, const std::vector<RigidMotion>& motions) {
  if (motions.size() == 6) return r;
  const VolumeMoments p = volume_moments(surface);
  const auto n = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd R(6, n), M = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index k = 0; k < n; ++k)
    R.col(k) << motions[static_cast<std::size_t>(k)].v, motions[static_cast<std::size_t>(k)].omega;
  M.topLeftCorner<3, 3>() = p.volume * Mat3::Identity();
  M.bottomRightCorner<3, 3>() = p.inertia;
  Eigen::Matrix<double, 6, 1> F = Eigen::Matrix<double, 6, 1>::Zero();
  F << r.force, r.moment;
  if (n == 0)
    F.setZero();
  else
    F = (M * R * (R.transpose() * M * R).inverse() * (R.transpose() * F)).eval();
  return {F.head<3>(), F.tail<3>(), r.scale, r.center};
}

std::vector<std::vector<double>> floating_motions(const TriMesh& surface,
                                                  const std::vector<BoundaryKind>& kinds) {
  const std::vector<int> part = connected_parts(surface);
  const std::vector<double> volume = volume_of_parts(surface, part);
  const std::vector<Mat3> held = held_at_nodes(surface, kinds);
  std::vector<std::vector<std::size_t>> nodes(volume.size());
  for (std::size_t i = 0; i < part.size(); ++i)
    nodes[part[i]].push_back(i);
  std::vector<std::vector<double>> modes;
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    Vec3 center = Vec3::Zero();
    for (std::size_t i : nodes[p])
      center += surface.positions[NodeId(i)] / static_cast<double>(nodes[p].size());
    std::vector<char> counts(part.size());  // a body is held by its cavities, too
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto of = static_cast<std::size_t>(part[i]);
      counts[i] = of == p || (volume[p] > 0 && volume[of] < 0);
    }
    add_motions(surface, nodes[p], center,
                motions_left(surface, held, counts, center, bounding_box(surface).diagonal()), modes);
  }
  return modes;
}

}  // namespace conchoid
