#include "conchoid/mesh/regions.hpp"

#include <algorithm>

namespace conchoid {
namespace {

bool holds_at_all_vertices(const Triangle& triangle, const std::vector<HalfSpace>& half_spaces) {
  return std::all_of(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& h) {
    return h.contains(triangle[0]) && h.contains(triangle[1]) && h.contains(triangle[2]);
  });
}

}  // namespace

std::vector<Region> select_regions(const TriMesh& mesh, const std::vector<RegionRule>& rules) {
  std::vector<Region> regions;
  for (const RegionRule& rule : rules)
    regions.push_back({rule.name, {}});
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle triangle = mesh.triangle(TriId(t));
    for (std::size_t r = 0; r < rules.size(); ++r)
      if (holds_at_all_vertices(triangle, rules[r].half_spaces)) {
        regions[r].triangles.push_back(TriId(t));
        break;
      }
  }
  return regions;
}

IdVector<TriId, int> region_of_triangles(const TriMesh& mesh, const std::vector<Region>& regions) {
  IdVector<TriId, int> region(mesh.triangle_count(), -1);
  for (std::size_t r = regions.size(); r-- > 0;)
    for (TriId t : regions[r].triangles)
      region[t] = static_cast<int>(r);
  return region;
}

const Region* find_region(const std::vector<Region>& regions, const std::string& name) {
  const auto found =
      std::find_if(regions.begin(), regions.end(), [&](const Region& r) { return r.name == name; });
  return found == regions.end() ? nullptr : &*found;
}

}  // namespace conchoid
