#include "conchoid/remesh/mend.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/flat_triangles.hpp"
#include "conchoid/remesh/inner_walls.hpp"
#include "conchoid/remesh/patch_intersections.hpp"
#include "conchoid/remesh/pinches.hpp"
#include "conchoid/remesh/tidy.hpp"
#include "conchoid/remesh/unite_bodies.hpp"
#include "conchoid/remesh/validate.hpp"

namespace conchoid {
namespace {

std::size_t drop_flat_parts(TriMesh& mesh) {
  const std::vector<SurfacePart> parts = surface_parts(mesh);
  std::vector<char> flat(mesh.triangle_count(), 0);
  std::size_t count = 0;
  for (const SurfacePart& part : parts) {
    if (!part.closed || std::abs(part.volume) > 1e-9 * std::pow(part.area, 1.5)) continue;
    ++count;
    for (const TriId t : part.triangles)
      flat[t.index()] = 1;
  }
  if (count == 0 || count == parts.size()) return 0;
  std::size_t t = 0;
  std::erase_if(mesh.corners, [&](const auto&) { return flat[t++] != 0; });
  return count;
}

/// Whether what touches at edges alone is parted there, between tips: last, as such edges may tell of bodies to be united.
enum class Edges { as_they_are, parted };

/// Connectivity: afterwards every edge has two triangles that run through it in both directions, and every node
/// one fan, where that can be had.
void mend_connectivity(TriMesh& mesh, Edges edges, MendReport& report) {
  report.dropped += drop_useless_triangles(mesh, false);
  report.flipped += flip_flat_triangles(mesh);
  orient_neighbours_alike(mesh);
  report.filled_holes += close_holes(mesh);
  const FlatTrianglesRemoved flat = remove_flat_triangles(mesh);
  report.flipped += flat.flipped;
  report.weld.nodes += flat.welded;
  report.dropped += drop_useless_triangles(mesh, false);
  report.inner_walls += drop_inner_walls(mesh);
  orient_neighbours_alike(mesh);
  turn_parts(mesh);
  report.split_nodes += split_pinches(mesh);
  if (std::vector<TriId> halved; edges == Edges::parted) report.split_nodes += part_edges(mesh, halved);
  report.flat_parts += drop_flat_parts(mesh);
  turn_parts(mesh);
}

}  // namespace

namespace {

enum class Bodies { as_they_are, united_first };

TriMesh mended(const TriMesh& mesh, Bodies bodies, Edges edges, MendReport& report) {
  report = {};
  Progress progress("mending", 4);
  throw_if_interrupted();
  TriMesh out = mesh;
  if (bodies == Bodies::united_first) report.united_bodies = unite_bodies(out);
  merge_equal_nodes(out);
  out = welded(out, report.weld);
  progress.advance();
  mend_connectivity(out, edges, report);
  drop_unused_nodes(out);
  progress.advance();
  throw_if_interrupted();
  const std::size_t united = unite_bodies(out);
  if (united > 0) mend_connectivity(out, edges, report);
  report.united_bodies += united;
  progress.advance();
  constexpr int most_rings = 3;
  for (int rings = 0; rings <= most_rings && !find_defects(out, 1).empty(); ++rings) {
    throw_if_interrupted();
    TriMesh tried = out;
    MendReport after = report;
    after.cut_triangles = patch_intersections(tried, rings);
    if (after.cut_triangles == 0) break;
    mend_connectivity(tried, edges, after);
    drop_unused_nodes(tried);
    if (!find_defects(tried, 1).empty()) continue;
    report = after;
    out = std::move(tried);
  }
  drop_unused_nodes(out);
  progress.advance();
  return out;
}

}  // namespace

TriMesh mended(const TriMesh& mesh, MendReport& report) {
  TriMesh out = mended(mesh, Bodies::as_they_are, Edges::as_they_are, report);
  if (find_defects(out, 1).empty()) return out;
  // Nodes of two bodies that coincide tie them together before they are cut by each other.
  MendReport other;
  TriMesh united = mended(mesh, Bodies::united_first, Edges::as_they_are, other);
  if (other.united_bodies > 0 && find_defects(united, 1).empty()) {
    report = other;
    return united;
  }
  TriMesh parted = mended(mesh, Bodies::as_they_are, Edges::parted, other);
  if (!find_defects(parted, 1).empty()) return out;
  report = other;
  return parted;
}

std::string MendReport::text() const {
  std::string out;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count > 0) out += (out.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(weld.nodes, "nodes welded, at most " + shortest(weld.farthest) + " apart");
  add(dropped, "doubled triangles dropped");
  add(flipped, "flat triangles flipped");
  add(filled_holes, "holes closed");
  add(inner_walls, "triangles of inner walls dropped");
  add(split_nodes, "nodes added where parts only touched");
  add(flat_parts, "parts without volume dropped");
  add(united_bodies, "overlapping bodies united with another");
  add(cut_triangles, "triangles around intersections replaced");
  return out;
}

}  // namespace conchoid
