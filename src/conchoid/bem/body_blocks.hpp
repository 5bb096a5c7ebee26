#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/bem/dense_matrix.hpp"
#include "conchoid/elastic/constants.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// Which unknown a node's displacement and a triangle's traction are: −1 where they are prescribed.
struct Unknowns {
  std::vector<int> displacement;  ///< per node: 0 … displacement_count−1
  std::vector<int> traction;      ///< per triangle: 0 … traction_count−1
  std::size_t displacement_count = 0, traction_count = 0;
};
Unknowns number_unknowns(const TriMesh& surface, const std::vector<BoundaryKind>& kinds);

/// Triangles around a node, each with the corner that the node is.
using CornersAround = std::vector<std::pair<std::size_t, int>>;
std::vector<CornersAround> corners_around_nodes(const TriMesh& surface);

/// The blocks of the uncracked body, unknown traction q on the displacement boundary, unknown displacement u
/// elsewhere:                                                                          docs/theory.md (B1)
///   | V  −K | |q|   |f_D|
///   | Kᵀ  D | |u| = |f_N|
/// Of D the part up to the diagonal's blocks is filled; V and K are whole.
struct BodyBlocks {
  std::vector<Panel> panels;               ///< per triangle
  std::vector<std::array<Vec3, 3>> curls;  ///< per triangle, of its corner functions
  Unknowns unknowns;
  DenseMatrix V, K, D;
};

BodyBlocks assemble_body(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                         const ElasticConstants& m, const PairIntegrator& integrator);

}  // namespace conchoid
