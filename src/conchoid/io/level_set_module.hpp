#pragma once

#include <string>
#include <vector>

#include "conchoid/core/module.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

constexpr Module kLevelSetModule{"conchoid_level_sets", "OpenVDB", "CONCHOID_WITH_VDB"};

/// What a grid is made from.
struct LevelSetSource {
  const TriMesh& mesh;
  std::string name;
  double mass, volume;  ///< [kg, m³], kept beside the grid
};

/// The bytes of a .vdb file with a level set for each, on one lattice of voxels.
/// @param voxel   edge [m]
/// @param origin  of the lattice [m]
using LevelSetBytes = void(const std::vector<LevelSetSource>& sources, double voxel, const Vec3& origin,
                           std::string& bytes);

}  // namespace conchoid
