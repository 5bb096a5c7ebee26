#include "conchoid/intersect/sheet_inside.hpp"

#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {

TriMesh sheet_inside(const CutComplex& cut) {
  std::vector<TriId> all;
  for (std::size_t t = 0; t < cut.sheet.size(); ++t)
    all.emplace_back(t);
  return submesh({cut.positions, cut.sheet}, all);
}

}  // namespace conchoid
