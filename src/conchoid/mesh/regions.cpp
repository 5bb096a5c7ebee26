#include "conchoid/mesh/regions.hpp"

#include <algorithm>

namespace conchoid {
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
