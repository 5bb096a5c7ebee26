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

Mat3 PairBlocks::hypersingular(const Vec3& b, const Vec3& a) const {
  const double ab = a.dot(b);
  // μ/4π Σ_k ∂_Sk ∂_Sk  +  (Mv)ᵀ [μ/2πR − 4μ²U] (Mu)  +  μ/4π Σ_k (M_kj v_i)(M_ki u_j)
  Mat3 block;
  Mat3 left;
  for (int q = 0; q < 3; ++q)
    left.col(q) = curl_kernel_.col(q).cross(b);
  for (int p = 0; p < 3; ++p) {
    const double r0 = left(p, 0), r1 = left(p, 1), r2 = left(p, 2), s = laplace_;
    block(p, 0) = (r1 * a.z() - r2 * a.y()) - (s * b[p]) * a[0];
    block(p, 1) = (r2 * a.x() - r0 * a.z()) - (s * b[p]) * a[1];
    block(p, 2) = (r0 * a.y() - r1 * a.x()) - (s * b[p]) * a[2];
  }
  block.diagonal().array() += 2 * laplace_ * ab;
  return block;
}

Mat3 PairBlocks::double_layer(const Vec3& a, double dl) const {
  Mat3 block = (2 * mu_ * kelvin_ - shear_ * Mat3::Identity()) * cross_matrix(a);
  block.diagonal().array() += dl / (4 * std::numbers::pi);
  return block;
}

}  // namespace conchoid
