#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/enrichment.hpp"
#include "conchoid/bem/enrichment_rows.hpp"

namespace conchoid {

/// An uncracked body as cracks meet it: its unknowns x = (q, u), its rows against the crack's functions, and the solution of
/// its system. Of linear elements, or of quadratic ones where the operator has them (BemSettings::quadratic).
class CrackHost {
 public:
  virtual ~CrackHost() = default;
  virtual std::size_t tractions() const = 0;  ///< unknown components q
  virtual std::size_t unknowns() const = 0;   ///< unknown components (q, u)
  virtual const HalfSolver& solver() const = 0;
  /// assemble_enrichment_rows() with the rows of these unknowns.
  virtual std::vector<EnrichmentRows> rows(const EnrichedSpace& space, std::span<const LoadSource> sources,
                                           const std::vector<std::size_t>& wanted,
                                           PairMemory* memory) const = 0;
  /// M P J f of loads f without a crack, one after the other; expand() makes unknowns of them. Errors: InputError when a load
  /// does not fit, or, of quadratic elements, prescribes a value: they take loads as fields (as_field()).
  virtual std::vector<double> reduced_loads(std::span<const LoadCase> loads) const = 0;
  /// Adds what x says to the displacement of the surface's nodes, and to the mean traction of its triangles.
  virtual void add_displacement(const double* x, IdVector<NodeId, Vec3>& u) const = 0;
  virtual void add_traction(const double* x, std::vector<Vec3>& t) const = 0;
};

std::unique_ptr<CrackHost> make_crack_host(std::shared_ptr<const BodyOperator> body);

}  // namespace conchoid
