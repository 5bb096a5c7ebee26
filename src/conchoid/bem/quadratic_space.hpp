#pragma once

#include <array>
#include <vector>

#include "conchoid/bem/body_entries.hpp"
#include "conchoid/bem/load_case.hpp"
#include "conchoid/quadrature/polynomial_pairs.hpp"

namespace conchoid {

/// An uncracked body with quadratic displacements (P2: nodes at corners and in the middles of edges) and tractions
/// linear on each triangle (P1, discontinuous), on flat triangles. Unknown are, as in BodyDiscretisation, the
/// displacement of free nodes and the traction of held triangles, here three vectors each, one per corner.
///                                                                                   docs/theory.md (B10)
struct QuadraticSpace {
  /// Errors: InputError when there is not one kind per triangle, or a tolerance is out of range.
  QuadraticSpace(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                 double quadrature_tolerance);

  BodyDiscretisation corners;  ///< the same body with its corners alone: panels, curls, held triangles
  PolynomialPairIntegrator integrator;
  std::vector<std::array<std::size_t, 6>>
      nodes;                                     ///< per panel: corners, then middles of the edges 01, 12, 20
  std::vector<Vec3> positions;                   ///< per node; those of the mesh come first
  std::vector<std::array<std::size_t, 2>> ends;  ///< per node: of the edge, or twice itself
  std::vector<std::size_t> free_nodes;
  std::vector<int> unknown;        ///< per node: position in free_nodes, or −1
  std::vector<Mat3> held;          ///< per node: projection onto the directions in which it is held
  std::vector<Mat3> unknown_part;  ///< per free node: I − held

  std::size_t tractions() const { return 9 * corners.held_triangles.size(); }
  std::size_t displacements() const { return 3 * free_nodes.size(); }

  /// Motions of the corners, 3 per mesh node, as motions of the free nodes.
  std::vector<double> on_free_nodes(const std::vector<double>& of_corners) const;
};

/// What is prescribed, in the space's own terms. Of body forces (LoadCase::ambient), whose field is not linear
/// on an edge, the traction at each corner and the displacement in each middle are used.
struct QuadraticData {
  QuadraticData(const QuadraticSpace& space, const LoadCase& load);
  std::vector<std::array<Vec3, 3>> traction;  ///< per panel, at its corners [Pa]
  std::vector<Vec3> displacement;             ///< per node [m]
};

}  // namespace conchoid
