#pragma once

#include <memory>

#include "conchoid/bem/body_solver.hpp"
#include "conchoid/bem/quadratic_space.hpp"
#include "conchoid/bem/schur_factors.hpp"

namespace conchoid {

/// Displacement and traction of an uncracked body with quadratic displacements, without the ambient field of its load.
struct QuadraticSolution {
  std::shared_ptr<const QuadraticSpace> space;
  std::vector<Vec3> displacement;             ///< per node of the space [m]
  std::vector<std::array<Vec3, 3>> traction;  ///< per panel, at its corners [Pa]
  AmbientField ambient;                       ///< of the load
};

/// The system (B1) of an uncracked body with quadratic displacements, assembled and factored once. Walls that bend do
/// not lock: a triangle follows constant curvature exactly. For conditions and loads as BodyOperator takes them.
///                                                                                   docs/theory.md (B10)
/// Memory for n triangles, a share h of them held: 144 n² (1 + ¾ h)² bytes (1,000 triangles: 144 … 440 MB).
class QuadraticBody {
 public:
  /// @param cache  where the factors are looked for and left; may be null
  /// Errors: InputError when there is not one kind per triangle; ComputationError when the system is singular.
  QuadraticBody(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                double quadrature_tolerance = 1e-6, const std::shared_ptr<const ByteCache>& cache = nullptr);

  const QuadraticSpace& space() const { return *space_; }

  /// Errors: InputError when the load does not fit (require_fitting_load).
  QuadraticSolution solve(const LoadCase& load) const;

  const SchurFactors& factors() const { return factors_; }
  std::size_t bytes() const { return factors_.bytes(); }

 private:
  void make_factors();
  void assemble_single_layer();
  void assemble_double_layer();
  void assemble_hypersingular();
  std::vector<double> right_hand_side(const QuadraticData& data) const;

  std::shared_ptr<const QuadraticSpace> space_;
  SchurFactors factors_;
};

}  // namespace conchoid
