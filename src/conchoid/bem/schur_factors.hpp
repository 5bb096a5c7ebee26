#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "conchoid/bem/body_solver.hpp"
#include "conchoid/bem/tiled_cholesky.hpp"

namespace conchoid {

/// Factors of a body's system by elimination of the tractions,
///   | V  −K | |q|   |f_D|        V = L Lᵀ / s ,   W = L⁻¹ K ,   S = D + α Σ r rᵀ + s Wᵀ W
///   | Kᵀ  D | |u| = |f_N|                                                             docs/theory.md (B1)
/// Filled in this order: V's tiles, factor_single_layer(), W with K, reduce_coupling(), S's tiles with D, factor().
/// The two factor…() throw ComputationError when what they are given is not definite.
class SchurFactors : public HalfSolver {
 public:
  SchurFactors(std::size_t tractions, std::size_t displacements)
      : nq_(tractions), nu_(displacements), V_(nq_), S_(nu_), W_(nq_ * nu_) {}

  std::size_t size() const { return nq_ + nu_; }
  std::size_t tractions() const { return nq_; }
  std::size_t displacements() const { return nu_; }
  std::size_t bytes() const { return V_.bytes() + S_.bytes() + W_.size() * sizeof(double); }

  TiledCholesky& V() { return V_; }
  TiledCholesky& S() { return S_; }
  std::vector<double>& W() { return W_; }  ///< column-major, nq × nu
  void factor_single_layer();
  void reduce_coupling();
  void factor(const RigidMotions& motions);

  void apply(const double* x, double* y, std::size_t count) const;
  // With  P = | L⁻¹             |   and M = diag(−s, s'), where s' S = L' L'ᵀ.
  //                                    | s L'⁻¹ Wᵀ  L'⁻¹ |
  void reduce(double* b, std::size_t count) const override;
  void middle(double* b, std::size_t count) const override;
  void expand(double* b, std::size_t count) const override;

  void put(ByteWriter& out) const;
  void get(ByteReader& in);

 private:
  template <class Task>
  void in_parts(double* vectors, std::size_t count, const Task& task) const;
  void multiply(bool transposed, std::size_t count, double factor, const double* from, double* to) const;
  void hold(const RigidMotions& motions);

  std::size_t nq_, nu_;
  TiledCholesky V_, S_;
  std::vector<double> W_;
};

}  // namespace conchoid
