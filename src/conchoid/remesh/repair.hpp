#pragma once

#include <array>
#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/remesh/mend.hpp"
#include "conchoid/remesh/tidy.hpp"

namespace conchoid {

enum class RepairMethod {
  none,      ///< the surface has no defects: it comes back as it is
  tidying,   ///< no point moved, see tidy.hpp
  mending,   ///< changed only where it is bad, see mend.hpp
  level_set  ///< holes filled, then made anew from a lattice, see voxel_surface.hpp, and simplified
};

struct Repair {
  RepairMethod method = RepairMethod::none;
  TriMesh mesh;
  TidyReport tidying;
  MendReport mending;
  double volume_before = 0;  ///< of the surface with its holes filled [m³]
  double volume_after = 0;   ///< [m³]

  // Of a level set only.
  double voxel = 0;                                ///< [m]
  std::array<std::size_t, 3> lattice = {0, 0, 0};  ///< points along x, y, z
  std::size_t lattice_triangles = 0;               ///< before they were simplified
  std::size_t filled_holes = 0;
  std::size_t dropped_specks = 0;  ///< parts of less than one voxel
  double moved =
      0;  ///< largest distance of the new surface from the old one and the patches in its holes [m]
  double lost =
      0;  ///< largest distance of a node of the old surface from the new one: inner walls, thin parts [m]
};

/// The least that makes find_defects content; what repaired() will do, at a fraction of the cost.
RepairMethod needed_repair(const TriMesh& mesh);

/// Longest extent / 200 [m].
double default_voxel(const TriMesh& mesh);

/// A surface that find_defects has nothing to say about, with as little change as possible: nothing, tidying,
/// mending, or a level set. A level set keeps sharp edges where planes of the old surface meet; details thinner
/// than about a voxel may be lost. It is simplified as far as the new surface stays within a fiftieth of a
/// voxel (root mean square) of the old one's planes. Same mesh and voxel, same bits.
/// @param voxel  [m], 0: default_voxel; given, the level set takes the place of mending
/// @throws InputError where the mesh has no extent, or the lattice would have more than 600³ points
/// @throws ComputationError where nothing is left inside (the surface bounds no volume at that voxel), or the
/// result still has defects
Repair repaired(const TriMesh& mesh, double voxel = 0);

}  // namespace conchoid
