#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"

namespace conchoid {

/// What acts on a body: the values that belong to the kinds of conditions its operator was made for.
struct LoadCase {
  std::vector<Vec3> traction;           ///< per triangle, t = σ·n [Pa]; zero in directions that are held
  IdVector<NodeId, Vec3> displacement;  ///< per node [m]; zero in directions that no triangle around it holds
  AmbientField ambient;                 ///< superposed; its traction is already taken off `traction`
};

/// The values of boundary data, without those that nothing reads: tractions in directions that are held,
/// displacements in directions that are free. Sizes are kept as they are.
LoadCase load_case(const TriMesh& surface, const BoundaryData& data, AmbientField ambient = {});

/// Per node, the projection onto the directions in which its displacement is prescribed: those that any triangle
/// around it holds.
std::vector<Mat3> held_at_nodes(const TriMesh& surface, const std::vector<BoundaryKind>& kinds);

/// Throws InputError when a load case does not fit a surface and its kinds of conditions: other numbers of
/// triangles or nodes, a value where the other quantity is prescribed, or one that is not finite.
void require_fitting_load(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                          const LoadCase& load);

}  // namespace conchoid
