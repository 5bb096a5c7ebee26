#include <cmath>

#include "conchoid/quadrature/potentials.hpp"

namespace conchoid {

namespace {

/// ∇N_1 and ∇N_2 in the plane.
std::array<Vec3, 2> corner_gradients(const PanelPotential& panel) {
  std::array<Vec3, 2> g;
  for (int j = 1; j < 3; ++j) {
    const int e = (j + 1) % 3;
    g[static_cast<std::size_t>(j - 1)] = -(panel.edge_length(e) / panel.double_area()) * panel.edge_normal(e);
  }
  return g;
}

}  // namespace

Eigen::Matrix<double, 7, 3> PanelPotential::linear_single_layer(const Vec3& x) const {
  const Terms q = terms(x, true);
  const double height = std::abs(q.h);
  Vec3 F = Vec3::Zero(), A = Vec3::Zero();
  double potential = -height * q.solid_angle;
  std::array<double, 3> second;  // ∫_e τ²/R, τ along the edge from the foot
  Mat3 S = Mat3::Zero();
  for (int e = 0; e < 3; ++e) {
    const double d2f = (q.p[e] * q.p[e] + q.h * q.h) * q.f[e];
    potential += q.p[e] * q.f[e];
    F += q.f[e] * outward_[e];
    A += 0.5 * (q.distance_moment[e] + d2f) * outward_[e];
    second[static_cast<std::size_t>(e)] = 0.5 * (q.distance_moment[e] - d2f);
    S -= (q.p[e] * q.f[e] * outward_[e] + q.distance_rise[e] * along_[e]) * outward_[e].transpose();
  }
  const Mat3 in_plane = Mat3::Identity() - normal_ * normal_.transpose();
  S += potential * in_plane;
  Eigen::Matrix<double, 7, 3> result;
  const double cap = height * q.solid_angle;
  result.col(0) << potential, symmetric_product(normal_, cap * normal_ + (2 * q.h) * F, 1.0);
  const auto add = [](auto&& column, const Mat3& m) {
    column[1] += m(0, 0);
    column[2] += m(1, 1);
    column[3] += m(2, 2);
    column[4] += 0.5 * (m(1, 2) + m(2, 1));
    column[5] += 0.5 * (m(0, 2) + m(2, 0));
    column[6] += 0.5 * (m(0, 1) + m(1, 0));
  };
  add(result.col(0), S);
  const Vec3 at_foot = corner_functions(x);
  const std::array<Vec3, 2> gradients = corner_gradients(*this);
  for (int j = 1; j < 3; ++j) {
    const Vec3& g = gradients[static_cast<std::size_t>(j - 1)];
    Mat3 W = A * g.transpose() + g.dot(A) * in_plane;
    for (int e = 0; e < 3; ++e) {
      const double gm = g.dot(outward_[e]), gt = g.dot(along_[e]), p = q.p[e], rise = q.distance_rise[e];
      W -= ((gm * p * p * q.f[e] + gt * p * rise) * outward_[e] +
            (gm * p * rise + gt * second[static_cast<std::size_t>(e)]) * along_[e]) *
           outward_[e].transpose();
    }
    W -= (q.h * q.h * g.dot(F)) * normal_ * normal_.transpose() + (2 * q.h) * normal_ * (S * g).transpose();
    auto column = result.col(j);
    column = at_foot[j] * result.col(0);
    column[0] += g.dot(A);
    add(column, W);
  }
  return result;
}

Eigen::Matrix<double, 6, 1> PanelPotential::quadratic_double_layer(const Vec3& x) const {
  const Terms q = terms(x, true);
  if (q.h == 0) return Eigen::Matrix<double, 6, 1>::Zero();
  Vec3 F = Vec3::Zero();
  double potential = -std::abs(q.h) * q.solid_angle;
  for (int e = 0; e < 3; ++e) {
    F += q.f[e] * outward_[e];
    potential += q.p[e] * q.f[e];
  }
  const auto second = [&](const Vec3& a, const Vec3& b) {
    double sum = potential * a.dot(b);
    for (int e = 0; e < 3; ++e)
      sum -=
          (q.p[e] * q.f[e] * a.dot(outward_[e]) + q.distance_rise[e] * a.dot(along_[e])) * b.dot(outward_[e]);
    return q.h * sum;
  };
  const double omega = std::copysign(q.solid_angle, q.h);
  const Vec3 N = corner_functions(x);
  const auto [g1, g2] = corner_gradients(*this);
  const double f1 = -q.h * g1.dot(F), f2 = -q.h * g2.dot(F);
  Eigen::Matrix<double, 6, 1> result;
  result << omega, N[1] * omega + f1, N[2] * omega + f2, N[1] * (N[1] * omega + 2 * f1) + second(g1, g1),
      N[1] * N[2] * omega + N[1] * f2 + N[2] * f1 + second(g1, g2),
      N[2] * (N[2] * omega + 2 * f2) + second(g2, g2);
  return result;
}

Eigen::Matrix<double, 3, 3> PanelPotential::linear_gradient(const Vec3& x) const {
  const Terms q = terms(x, true);
  const double omega = q.h == 0 ? 0.0 : std::copysign(q.solid_angle, q.h);
  Vec3 F = Vec3::Zero();
  double potential = -std::abs(q.h) * q.solid_angle;
  for (int e = 0; e < 3; ++e) {
    F += q.f[e] * outward_[e];
    potential += q.p[e] * q.f[e];
  }
  const Vec3 N = corner_functions(x);
  const std::array<Vec3, 2> gradients = corner_gradients(*this);
  Eigen::Matrix<double, 3, 3> result;
  result.col(0) = -(omega * normal_ + F);
  for (int j = 1; j < 3; ++j) {
    const Vec3& g = gradients[static_cast<std::size_t>(j - 1)];
    Vec3 moment = potential * g + (q.h * g.dot(F)) * normal_;
    for (int e = 0; e < 3; ++e)
      moment -= (q.p[e] * q.f[e] * g.dot(outward_[e]) + q.distance_rise[e] * g.dot(along_[e])) * outward_[e];
    result.col(j) = N[j] * result.col(0) + moment;
  }
  return result;
}

}  // namespace conchoid
