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

/// The points x with normal·x > offset; the normal need not be a unit vector.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  ///< [m] when the normal is a unit vector

  bool contains(const Vec3& x) const { return normal.dot(x) > offset; }
};

/// What a scene says about one region: the intersection of half spaces (none: everything).
struct RegionRule {
  std::string name;
  std::vector<HalfSpace> half_spaces;
};

/// One region per rule, in their order: a triangle belongs to the first rule whose half spaces hold strictly
/// at all three of its vertices. Triangles that no rule wants are in no region; a rule that gets no triangle
/// yields an empty region.
std::vector<Region> select_regions(const TriMesh& mesh, const std::vector<RegionRule>& rules);

/// Index into `regions` per triangle, −1 where a triangle is in none; the first one where it is in several.
IdVector<TriId, int> region_of_triangles(const TriMesh& mesh, const std::vector<Region>& regions);

/// The region of that name, or nullptr.
const Region* find_region(const std::vector<Region>& regions, const std::string& name);

}  // namespace conchoid
