#include "conchoid/remesh/separate_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/mesh/winding_number.hpp"

namespace conchoid {

std::vector<std::vector<TriId>> separate_bodies(const TriMesh& mesh) {
  const std::vector<SurfacePart> parts = surface_parts(mesh);
  std::vector<std::vector<TriId>> bodies;
  std::vector<std::size_t> part_of_body;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!parts[p].cavity()) {
      part_of_body.push_back(p);
      bodies.push_back(parts[p].triangles);
    }
  for (const SurfacePart& cavity : parts) {
    if (!cavity.cavity()) continue;
    const Vec3& x = mesh.positions[mesh.corners[cavity.triangles.front()][0]];
    std::size_t owner = bodies.size();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const SurfacePart& outer = parts[part_of_body[b]];
      if (outer.depth + 1 == cavity.depth &&
          std::abs(winding_number(submesh(mesh, outer.triangles), x)) > 0.5)
        owner = b;
    }
    if (owner == bodies.size()) continue;
    bodies[owner].insert(bodies[owner].end(), cavity.triangles.begin(), cavity.triangles.end());
  }
  for (std::vector<TriId>& body : bodies)
    std::sort(body.begin(), body.end());
  return bodies;
}

}  // namespace conchoid
