#include "conchoid/remesh/patch_intersections.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/polygon_triangles.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/edge_sides.hpp"
#include "conchoid/remesh/tidy.hpp"

namespace conchoid {

std::size_t close_holes(TriMesh& mesh) {
  std::map<Edge, int> count;
  for_each_edge(sides_by_edge(mesh),
                [&](auto begin, auto end) { count[begin->edge] = static_cast<int>(end - begin); });
  std::size_t closed = 0;
  for (const BoundaryLoop& loop : boundary_loops(mesh)) {
    bool is_hole = loop.size() > 2;
    for (std::size_t i = 0; i < loop.size() && is_hole; ++i)
      is_hole = count[Edge(loop[i], loop[(i + 1) % loop.size()])] == 1;
    if (!is_hole) continue;
    const BoundaryLoop rim(loop.rbegin(), loop.rend());
    const auto joined = [&](NodeId p, NodeId q) { return count.contains(Edge(p, q)); };
    for (const PolygonTriangle& t : polygon_triangles(mesh.positions, rim, joined)) {
      mesh.corners.push_back({rim[t[0]], rim[t[1]], rim[t[2]]});
      for (std::size_t k = 0; k < 3; ++k)
        ++count[Edge(rim[t[k]], rim[t[(k + 1) % 3]])];
    }
    ++closed;
  }
  return closed;
}

namespace {

/// Keeps, of what each old part has become, the pieces that are large.
void drop_scraps(TriMesh& mesh, const std::vector<std::size_t>& old_part) {
  const std::vector<SurfacePart> pieces = surface_parts(mesh);
  std::map<std::size_t, double> largest;
  for (const SurfacePart& piece : pieces) {
    double& area = largest[old_part[piece.triangles.front().index()]];
    area = std::max(area, piece.area);
  }
  constexpr double scrap = 0.1;
  IdVector<TriId, char> kept(mesh.triangle_count(), 0);
  for (const SurfacePart& piece : pieces)
    if (piece.area >= scrap * largest[old_part[piece.triangles.front().index()]])
      for (const TriId t : piece.triangles)
        kept[t] = 1;
  std::size_t t = 0;
  std::erase_if(mesh.corners, [&](const auto&) { return !kept[TriId(t++)]; });
}

}  // namespace

std::size_t patch_intersections(TriMesh& mesh, int rings, double most) {
  IdVector<TriId, char> out(mesh.triangle_count(), 0);
  const auto pairs = self_intersections(mesh, std::numeric_limits<std::size_t>::max());
  if (pairs.empty()) return 0;
  for (const auto& [s, t] : pairs)
    out[s] = out[t] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    IdVector<NodeId, char> touched(mesh.node_count(), 0);
    for (std::size_t t = 0; t < out.size(); ++t)
      if (out[TriId(t)])
        for (const NodeId n : mesh.corners[TriId(t)])
          touched[n] = 1;
    for (std::size_t t = 0; t < out.size(); ++t)
      for (const NodeId n : mesh.corners[TriId(t)])
        if (touched[n]) out[TriId(t)] = 1;
  }
  double area = 0;
  for (std::size_t t = 0; t < out.size(); ++t)
    if (out[TriId(t)]) area += area_vector(mesh, TriId(t)).norm();
  if (area > most * surface_area(mesh)) return 0;

  const std::vector<int> part = connected_parts(mesh);
  TriMesh rest;
  rest.positions = mesh.positions;
  std::vector<std::size_t> old_part;
  for (std::size_t t = 0; t < out.size(); ++t)
    if (!out[TriId(t)]) {
      rest.corners.push_back(mesh.corners[TriId(t)]);
      old_part.push_back(static_cast<std::size_t>(part[mesh.corners[TriId(t)][0].index()]));
    }
  const std::size_t removed = mesh.triangle_count() - rest.triangle_count();
  if (rest.corners.empty()) return 0;
  drop_scraps(rest, old_part);
  close_holes(rest);
  mesh = std::move(rest);
  return removed;
}

}  // namespace conchoid
