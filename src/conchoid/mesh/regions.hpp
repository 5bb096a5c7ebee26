#pragma once

#include <string>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A named part of a surface.
struct Region {
  std::string name;
  std::vector<TriId> triangles;  ///< ascending
};

/// Index into `regions` per triangle, −1 where a triangle is in none; the first one where it is in several.
IdVector<TriId, int> region_of_triangles(const TriMesh& mesh, const std::vector<Region>& regions);

/// The region of that name, or nullptr.
const Region* find_region(const std::vector<Region>& regions, const std::string& name);

}  // namespace conchoid
