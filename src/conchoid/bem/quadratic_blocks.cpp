#include "conchoid/bem/quadratic_blocks.hpp"

#include <numbers>

#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {
namespace {

using Curling = Eigen::Matrix<double, 6, 6>;

/// Row k, column 2 a + (α − 1): c(φ_k) = Σ N_a c_α, with c_0 = −c_1 − c_2 taken out.
const Curling& curling() {
  static const Curling table = [] {
    Curling C = Curling::Zero();
    const auto add = [&](int k, int a, int alpha, double value) {
      if (alpha > 0)
        C(k, 2 * a + alpha - 1) += value;
      else
        for (int other = 0; other < 2; ++other)
          C(k, 2 * a + other) -= value;
    };
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 3; ++a)
        add(k, a, k, a == k ? 3 : -1);
      const int next = (k + 1) % 3;
      add(3 + k, k, next, 4);
      add(3 + k, next, k, 4);
    }
    return C;
  }();
  return table;
}

}  // namespace

QuadraticBlocks::QuadraticBlocks(const LinearSingleLayerPair& pair, const ElasticConstants& m) {
  blocks_.reserve(pair.size());
  for (const SingleLayerPair& part : pair)
    blocks_.emplace_back(part, m);
}

QuadraticBlocks::Tractions QuadraticBlocks::single_layer() const {
  Tractions out;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      out.block<3, 3>(3 * a, 3 * b) = blocks_[static_cast<std::size_t>(3 * a + b)].single_layer();
  return out;
}

QuadraticBlocks::Displacements QuadraticBlocks::hypersingular(const Curls& test, const Curls& trial) const {
  std::array<Curling, 9> E;  // per component, between the functions N_a c_α
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int alpha = 0; alpha < 2; ++alpha)
        for (int beta = 0; beta < 2; ++beta) {
          const Mat3 block = blocks_[static_cast<std::size_t>(3 * a + b)].hypersingular(
              test[static_cast<std::size_t>(1 + alpha)], trial[static_cast<std::size_t>(1 + beta)]);
          for (int p = 0; p < 3; ++p)
            for (int q = 0; q < 3; ++q)
              E[static_cast<std::size_t>(3 * p + q)](2 * a + alpha, 2 * b + beta) = block(p, q);
        }
  const Curling& C = curling();
  Displacements out;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      const Curling of_functions = C * E[static_cast<std::size_t>(3 * p + q)] * C.transpose();
      for (int l = 0; l < 6; ++l)
        for (int k = 0; k < 6; ++k)
          out(3 * k + p, 3 * l + q) = of_functions(k, l);
    }
  return out;
}

QuadraticBlocks::Mixed QuadraticBlocks::double_layer(const Curls& trial,
                                                     const QuadraticDoubleLayerPair& laplace) const {
  const Curling& C = curling();
  Mixed out = Mixed::Zero();
  for (int k = 0; k < 6; ++k)
    for (int b = 0; b < 3; ++b) {
      const Vec3 c = C(k, 2 * b) * trial[1] + C(k, 2 * b + 1) * trial[2];
      for (int a = 0; a < 3; ++a)
        out.block<3, 3>(3 * a, 3 * k) += blocks_[static_cast<std::size_t>(3 * a + b)].double_layer(c, 0);
    }
  for (int k = 0; k < 6; ++k)
    for (int a = 0; a < 3; ++a)
      out.block<3, 3>(3 * a, 3 * k).diagonal().array() += laplace(a, k) / (4 * std::numbers::pi);
  return out;
}

Eigen::Matrix<double, 3, 6> quadratic_mass(double area) {
  Eigen::Matrix<double, 3, 6> M = Eigen::Matrix<double, 3, 6>::Zero();
  for (const RulePoint& p : triangle_rule(4).points) {
    const Vec3 l(p.l0, p.l1, p.l2);
    M += p.weight * area * l * quadratic_functions(l).transpose();
  }
  return M;
}

}  // namespace conchoid
