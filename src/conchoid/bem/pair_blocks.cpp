#include "conchoid/bem/pair_blocks.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace conchoid {

Mat3 cross_matrix(const Vec3& c) {
  Mat3 m;
  m << 0, -c.z(), c.y(), c.z(), 0, -c.x(), -c.y(), c.x(), 0;
  return m;
}

std::array<Vec3, 3> surface_curls(const Panel& p) {
  // ∇φ_k = n × (opposite edge) / 2A, hence n × ∇φ_k = −(opposite edge) / 2A
  std::array<Vec3, 3> c;
  for (int k = 0; k < 3; ++k)
    c[k] = (p.x[(k + 1) % 3] - p.x[(k + 2) % 3]) / (2 * p.area);
  return c;
}

PairBlocks::PairBlocks(const SingleLayerPair& s, const ElasticConstants& m) : mu_(m.shear_modulus()) {
  const double nu = m.poisson_ratio;
  const double pi = std::numbers::pi;
  Mat3 tensor;
  tensor << s.tensor[0], s.tensor[5], s.tensor[4],  //
      s.tensor[5], s.tensor[1], s.tensor[3],        //
      s.tensor[4], s.tensor[3], s.tensor[2];
  shear_ = s.laplace / (4 * pi);
  laplace_ = mu_ * shear_;
  kelvin_ = ((3 - 4 * nu) * s.laplace * Mat3::Identity() + tensor) / (16 * pi * mu_ * (1 - nu));
  curl_kernel_ = mu_ / (2 * pi) * s.laplace * Mat3::Identity() - 4 * mu_ * mu_ * kelvin_;
}

// μ/4π Σ_k ∂_Sk ∂_Sk  +  (Mv)ᵀ [μ/2πR − 4μ²U] (Mu)  +  μ/4π Σ_k (M_kj v_i)(M_ki u_j), with M u = [a]× and M v = [b]×
void PairBlocks::TrialSum::add(const PairBlocks& pair, const Vec3& a) {
  const Mat3& C = pair.curl_kernel_;
  Mat3& sum = curl_kernel_;
  for (int j = 0; j < 3; ++j) {
    sum(j, 0) += C(j, 1) * a.z() - C(j, 2) * a.y();
    sum(j, 1) += C(j, 2) * a.x() - C(j, 0) * a.z();
    sum(j, 2) += C(j, 0) * a.y() - C(j, 1) * a.x();
  }
  laplace_ += pair.laplace_ * a;
}

Mat3 PairBlocks::TrialSum::tested(const Vec3& b) const {
  const Mat3& s = curl_kernel_;
  Mat3 block;
  for (int q = 0; q < 3; ++q) {
    block(0, q) = (s(1, q) * b.z() - s(2, q) * b.y()) - b.x() * laplace_[q];
    block(1, q) = (s(2, q) * b.x() - s(0, q) * b.z()) - b.y() * laplace_[q];
    block(2, q) = (s(0, q) * b.y() - s(1, q) * b.x()) - b.z() * laplace_[q];
  }
  block.diagonal().array() += 2 * b.dot(laplace_);
  return block;
}

Mat3 PairBlocks::hypersingular(const Vec3& b, const Vec3& a) const {
  TrialSum sum;
  sum.add(*this, a);
  return sum.tested(b);
}

Mat3 PairBlocks::double_layer(const Vec3& a, double dl) const {
  Mat3 block = (2 * mu_ * kelvin_ - shear_ * Mat3::Identity()) * cross_matrix(a);
  block.diagonal().array() += dl / (4 * std::numbers::pi);
  return block;
}

}  // namespace conchoid
