#include "conchoid/remesh/unite_bodies.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/flat_triangles.hpp"
#include "conchoid/remesh/tidy.hpp"
#include "conchoid/remesh/weld.hpp"

namespace conchoid {
namespace {

/// Two parts that meet and can be united.
std::optional<std::pair<std::size_t, std::size_t>> meeting_parts(const TriMesh& mesh,
                                                                 const std::vector<SurfacePart>& parts) {
  IdVector<TriId, std::size_t> part_of(mesh.triangle_count());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const TriId t : parts[p].triangles)
      part_of[t] = p;
  const auto is_body = [&](std::size_t p) { return parts[p].closed && parts[p].volume > 0; };
  for (const auto& [s, t] : self_intersections(mesh, std::numeric_limits<std::size_t>::max())) {
    const std::size_t p = part_of[s], q = part_of[t];
    if (p != q && is_body(p) && is_body(q)) return std::pair(std::min(p, q), std::max(p, q));
  }
  return std::nullopt;
}

/// Cut pieces have needles and flat triangles where an edge of one passes close to a node of the other.
void clean(TriMesh& mesh) {
  WeldReport weld;
  mesh = welded(mesh, weld);
  drop_useless_triangles(mesh, false);
  flip_flat_triangles(mesh);
}

std::optional<TriMesh> united(const TriMesh& a, const TriMesh& b) {
  TriMesh out;
  try {
    SplitSurfaces split = split_by_each_other(a, b);
    out.positions = std::move(split.positions);
    for (const auto* pieces : {&split.first, &split.second})
      for (const SplitSurfaces::Piece& piece : *pieces)
        if (!piece.inside) out.corners.push_back(piece.corners);
  } catch (const ComputationError&) {  // one of them passes through itself
    return std::nullopt;
  }
  if (out.corners.empty()) return std::nullopt;
  clean(out);
  drop_unused_nodes(out);
  return out;
}

}  // namespace

std::size_t unite_bodies(TriMesh& mesh) {
  std::size_t count = 0;
  while (true) {
    throw_if_interrupted();
    const std::vector<SurfacePart> parts = surface_parts(mesh);
    if (parts.size() < 2) return count;
    const auto pair = meeting_parts(mesh, parts);
    if (!pair) return count;
    std::optional<TriMesh> one =
        united(submesh(mesh, parts[pair->first].triangles), submesh(mesh, parts[pair->second].triangles));
    if (!one) return count;
    ++count;
    std::vector<TriMesh> all = {*std::move(one)};
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (p != pair->first && p != pair->second) all.push_back(submesh(mesh, parts[p].triangles));
    mesh = join(all);
  }
}

}  // namespace conchoid
