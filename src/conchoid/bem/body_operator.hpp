#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "conchoid/bem/body_entries.hpp"
#include "conchoid/bem/body_solver.hpp"
#include "conchoid/bem/load_case.hpp"
#include "conchoid/bem/load_columns.hpp"

namespace conchoid {

class QuadraticBody;

struct BemSettings {
  /// Wanted relative error of the integrals of a pair of the body's triangles, 1e-3 … 1e-11; of pairs with a crack's triangle
  /// crack_tolerance() of it, but for those of a crack with quadratic elements.
  double quadrature_tolerance = 1e-6;
  bool contact = true;           ///< crack faces do not interpenetrate (they slide without friction)
  std::string solver = "dense";  ///< one of body_solver_names()
  std::shared_ptr<const ByteCache> cache = nullptr;  ///< of factors and columns of loads, made or used before
  /// The same body with quadratic elements, in which cracks then open (CrackHost); none: in these, linear ones.
  std::shared_ptr<const QuadraticBody> quadratic = nullptr;
};

/// Walls that bend cancel most of what the body's pairs add up to; K cancels nothing and needs less: with a hundred times the error
/// it moves by some 1e-5 (docs/verification.md), and rows take a quarter less time.
constexpr double crack_tolerance(double quadrature_tolerance) {
  return std::min(100 * quadrature_tolerance, 1e-3);
}

/// An uncracked elastic body: surface, material, and which quantity is prescribed where. Its boundary element
/// system is assembled and factored once, on construction; what is prescribed comes later, as load cases.
///   | V  −K | |q|   |f_D|      q unknown tractions, u unknown displacements
///   | Kᵀ  D | |u| = |f_N|                                                             docs/theory.md (B1)
/// Immutable but for the columns of loads, which it keeps (LoadColumns): threads and any number of cracked
/// bodies share one through shared_ptr<const BodyOperator>.
/// Memory for n triangles, a share h of them held, with the dense solver: 9 n² (1 + h)² bytes for the factors
/// (1,000 triangles: 9 … 36 MB), 28 n² more while they are made, and 36 n (1 + h) bytes per place that a load
/// has touched.
class BodyOperator {
 public:
  /// @param surface   closed, outward; empty for an unbounded body
  /// @param kinds     per triangle
  /// @param expected  loads to come: their columns are made while the integrals of all pairs are at hand
  /// Errors: InputError when there is not one kind per triangle, a load does not fit, or the solver's name is
  /// not known; ComputationError when the system is singular (the mesh has overlapping or nearly degenerate
  /// triangles).
  BodyOperator(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
               const BemSettings& settings = {}, std::span<const LoadCase> expected = {});

  const TriMesh& surface() const { return discretisation_.surface; }
  const std::vector<BoundaryKind>& kinds() const { return discretisation_.kinds; }
  const ElasticConstants& material() const { return discretisation_.m; }
  const BemSettings& settings() const { return settings_; }
  const BodyDiscretisation& discretisation() const { return discretisation_; }
  const BodyEntries& entries() const { return entries_; }
  const BodySolver& solver() const { return *solver_; }

  /// Right-hand sides (f_D, f_N) of load cases, one after the other.
  /// Errors: InputError when one does not fit (require_fitting_load).
  std::vector<double> right_hand_sides(std::span<const LoadCase> loads) const;
  /// M P J f of load cases (HalfSolver), one after the other; expand() makes the unknowns of them.
  std::vector<double> reduced(std::span<const LoadCase> loads) const;
  /// The unknowns (q, u) of load cases, one after the other.
  std::vector<double> solve(std::span<const LoadCase> loads) const;

  /// Memory of factors and load columns.
  std::size_t bytes() const { return solver_->bytes() + columns_.bytes(); }

 private:
  RigidMotions rigid_motions() const;
  KeptSystem kept() const;
  void make_columns(std::span<const LoadCase> loads);

  BemSettings settings_;
  BodyDiscretisation discretisation_;
  BodyEntries entries_;
  std::unique_ptr<BodySolver> solver_;
  mutable LoadColumns columns_;
};

/// Where the factors of a body's system are kept: under a name of `what` (solver or elements) and all that they depend on.
/// @param cache  may be null
KeptSystem kept_system(const std::shared_ptr<const ByteCache>& cache, const std::string& what,
                       const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                       const ElasticConstants& m, double quadrature_tolerance);

/// An operator for the kinds that some boundary data have, with their values as the load to come.
std::shared_ptr<const BodyOperator> make_body_operator(TriMesh surface, const BoundaryData& data,
                                                       const ElasticConstants& m,
                                                       const BemSettings& settings = {});

}  // namespace conchoid
