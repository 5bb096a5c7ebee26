#pragma once

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Integrals over the solid enclosed by a closed mesh, exact for the polyhedron (sums over tetrahedra with a
/// common apex).
struct MassProperties {
  double volume = 0;                   ///< [m³]
  double mass = 0;                     ///< [kg]
  Vec3 center_of_mass = Vec3::Zero();  ///< centre of the box for a solid without volume
  Mat3 inertia = Mat3::Zero();         ///< ∫ρ(|r|² I − r rᵀ), r from the centre of mass [kg m²]
};
MassProperties mass_properties(const TriMesh& closed, double density);

/// Whether every edge of the mesh has two triangles that run along it in opposite directions.
bool is_watertight(const TriMesh& mesh);

}  // namespace conchoid
