#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conchoid/bem/body_entries.hpp"
#include "conchoid/bem/half_solver.hpp"
#include "conchoid/core/byte_cache.hpp"

namespace conchoid {

/// The system of an uncracked body, ready to be solved. Vectors hold the unknown tractions q, then the unknown
/// displacements u; several of them lie one after the other.
///   A x = | V  −K          | |q|         r: orthonormal rigid motions of parts that nothing holds; the last
///         | Kᵀ  D + α Σrrᵀ | |u|            term leaves the solution of balanced loads as it is, without r
/// Everything else (cracks, loads) goes through these functions, so another representation of A (compressed,
/// on another device, iterative) is a class of its own and one line in body_solver.cpp.
class BodySolver : public HalfSolver {
 public:
  /// y = A x.
  virtual void apply(const double* x, double* y, std::size_t count = 1) const = 0;
  /// Memory that the solver holds.
  virtual std::size_t bytes() const = 0;
};

/// Rigid motions in terms of the unknown displacements, each 3·free nodes long.
using RigidMotions = std::vector<std::vector<double>>;

/// Where a solver looks for what it is about to make, and leaves it: none, and nothing is kept.
struct KeptSystem {
  const ByteCache* cache = nullptr;
  std::string name;  ///< of everything the system depends on
};

/// Errors: ComputationError when the system is not definite (the mesh has overlapping or nearly degenerate
/// triangles).
using BodySolverFactory = std::unique_ptr<BodySolver> (*)(BodyEntries& entries, const RigidMotions& motions,
                                                          const KeptSystem& kept);

/// Names of the solvers there are, the default first.
std::vector<std::string> body_solver_names();
/// Errors: InputError for a name that is not known.
std::unique_ptr<BodySolver> make_body_solver(const std::string& name, BodyEntries& entries,
                                             const RigidMotions& motions, const KeptSystem& kept = {});

}  // namespace conchoid
