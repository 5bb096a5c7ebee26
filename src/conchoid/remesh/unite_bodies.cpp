#include "conchoid/remesh/unite_bodies.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
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

bool is_body(const SurfacePart& part) {
  return part.closed && part.volume > 0;
}

/// Pairs of bodies that pass through or touch each other.
std::set<std::pair<std::size_t, std::size_t>> meeting_bodies(const TriMesh& mesh,
                                                             const std::vector<SurfacePart>& parts) {
  IdVector<TriId, std::size_t> part_of(mesh.triangle_count());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const TriId t : parts[p].triangles)
      part_of[t] = p;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [s, t] : self_intersections(mesh, std::numeric_limits<std::size_t>::max())) {
    const std::size_t p = part_of[s], q = part_of[t];
    if (p != q && is_body(parts[p]) && is_body(parts[q])) pairs.emplace(std::min(p, q), std::max(p, q));
  }
  return pairs;
}

/// Cut pieces have needles and flat triangles where an edge of one passes close to a node of the other.
void clean(TriMesh& mesh) {
  WeldReport weld;
  mesh = welded(mesh, weld);
  drop_useless_triangles(mesh, false);
  flip_flat_triangles(mesh);
}

/// Both as one body; nothing where they stay two, as such do that touch in points.
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
  const std::vector<SurfacePart> parts = surface_parts(out);
  if (std::count_if(parts.begin(), parts.end(), is_body) > 1) return std::nullopt;
  return out;
}

/// Unites the first pair that can be.
bool unite_two(TriMesh& mesh) {
  const std::vector<SurfacePart> parts = surface_parts(mesh);
  if (parts.size() < 2) return false;
  for (const auto& [a, b] : meeting_bodies(mesh, parts)) {
    throw_if_interrupted();
    std::optional<TriMesh> one = united(submesh(mesh, parts[a].triangles), submesh(mesh, parts[b].triangles));
    if (!one) continue;
    std::vector<TriMesh> all = {*std::move(one)};
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (p != a && p != b) all.push_back(submesh(mesh, parts[p].triangles));
    mesh = join(all);
    return true;
  }
  return false;
}

}  // namespace

std::size_t unite_bodies(TriMesh& mesh) {
  std::size_t count = 0;
  while (unite_two(mesh))
    ++count;
  return count;
}

}  // namespace conchoid
