#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/bem/body_load.hpp"
#include "conchoid/bem/bordered_cholesky.hpp"

namespace conchoid {

struct BemSettings {
  double quadrature_tolerance = 1e-6;  ///< wanted relative error of a pair's integrals, 1e-3 … 1e-11
  bool contact = true;                 ///< crack faces do not interpenetrate (they slide without friction)
};

/// An uncracked elastic body: surface, material, and which quantity is prescribed where. Its boundary element
/// system is assembled and factored once, on construction; what is prescribed comes later, as load cases.
/// Immutable: threads and any number of cracked bodies share one through shared_ptr<const BodyOperator>.
///
///   | V  −K | |q|   |f_D|     S = D + Kᵀ V⁻¹ K + Σ α r rᵀ,   S u = f_N − Kᵀ V⁻¹ f_D,   q = V⁻¹ (f_D + K u)
///   | Kᵀ  D | |u| = |f_N|     r: rigid motions that nothing holds                     docs/theory.md (B1)
class BodyOperator {
 public:
  /// @param surface  closed, outward; empty for an unbounded body
  /// @param kinds    per triangle
  /// Errors: InputError when there is not one kind per triangle; ComputationError when the system is
  /// singular (the mesh has overlapping or nearly degenerate triangles).
  BodyOperator(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
               const BemSettings& settings = {});

  const TriMesh& surface() const { return surface_; }
  const std::vector<BoundaryKind>& kinds() const { return kinds_; }
  const ElasticConstants& material() const { return m_; }
  const BemSettings& settings() const { return settings_; }
  const PairIntegrator& integrator() const { return integrator_; }
  const BodyBlocks& blocks() const { return body_; }

  /// Right-hand side of a load case. Errors: InputError when it does not fit (require_fitting_load).
  BodyLoad load(const LoadCase& load) const;
  std::vector<BodyLoad> loads(std::span<const LoadCase> loads) const;

  /// V⁻¹ b in place for `count` vectors of tractions, each contiguous.
  void solve_single_layer(double* b, std::size_t count = 1) const;
  /// V⁻¹ K.
  const DenseMatrix& VinvK() const { return VinvK_; }
  /// The factor of S, to be bordered by the rows of cracks.
  const BorderedCholesky& schur_factor() const { return S_; }

 private:
  void factor();
  void hold_rigid_motions(DenseMatrix& schur) const;

  TriMesh surface_;
  std::vector<BoundaryKind> kinds_;
  ElasticConstants m_;
  BemSettings settings_;
  PairIntegrator integrator_;
  BodyBlocks body_;
  BorderedCholesky V_, S_;
  DenseMatrix VinvK_;
};

/// An operator for the kinds that some boundary data have.
std::shared_ptr<const BodyOperator> make_body_operator(TriMesh surface, const BoundaryData& data,
                                                       const ElasticConstants& m,
                                                       const BemSettings& settings = {});

}  // namespace conchoid
