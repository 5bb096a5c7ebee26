#pragma once

#include <vector>

#include "conchoid/bem/dense_matrix.hpp"
#include "conchoid/bem/enrichment.hpp"
#include "conchoid/bem/interior_stress.hpp"
#include "conchoid/bem/quadratic_space.hpp"

namespace conchoid {

/// Rows of a crack's functions, which are linear, against the unknowns of a body of quadratic elements: K_aᵀ against its
/// tractions, D against its displacements, 3 × unknowns each. On the pieces into which the mouth cuts a triangle the
/// triangle's own functions are taken as they are, polynomials of the same degree.
///                                                                            docs/theory.md (B5), (B6), (B10)
/// @param wanted  indices into enriched.functions
std::vector<DenseMatrix> assemble_quadratic_rows(const QuadraticSpace& body, const EnrichedSpace& enriched,
                                                 const std::vector<std::size_t>& wanted);

/// The panels after the cut with what the body's unknowns x say; cracks, and what their functions add, are left zero.
std::vector<QuadraticLoadedPanel> loaded_pieces(const QuadraticSpace& body, const EnrichedSpace& enriched,
                                                const std::vector<double>& x);

}  // namespace conchoid
