#include "conchoid/remesh/weld.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "conchoid/core/cells.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/mesh/carry_attributes.hpp"
#include "conchoid/remesh/edge_sides.hpp"
#include "conchoid/remesh/tidy.hpp"
#include "conchoid/remesh/validate.hpp"

namespace conchoid {
namespace {

/// Per node the distance within which it meets others; 0 where it has no seam to close.
IdVector<NodeId, double> reaches(const TriMesh& mesh, const std::vector<EdgeSide>& sides, double share) {
  IdVector<NodeId, double> reach(mesh.node_count(), 0);
  for_each_edge(sides, [&](auto begin, auto) {
    const Edge& e = begin->edge;
    const double length = share * (mesh.positions[e.a] - mesh.positions[e.b]).norm();
    for (const NodeId n : {e.a, e.b})
      reach[n] = std::max(reach[n], length);
  });
  return reach;
}

IdVector<NodeId, char> at_seam(const TriMesh& mesh, const std::vector<EdgeSide>& sides) {
  IdVector<NodeId, char> seam(mesh.node_count(), 0);
  for_each_edge(sides, [&](auto begin, auto end) {
    if (end - begin != 2) seam[begin->edge.a] = seam[begin->edge.b] = 1;
  });
  return seam;
}

void join_seams(const TriMesh& mesh, const IdVector<NodeId, double>& reach,
                const IdVector<NodeId, char>& seam, UnionFind& nodes) {
  double cell = 0;
  for (std::size_t n = 0; n < reach.size(); ++n)
    if (seam[NodeId(n)]) cell = std::max(cell, reach[NodeId(n)]);
  if (!(cell > 0)) return;
  const Vec3 low = bounding_box(mesh).low;
  std::unordered_map<Cell, std::vector<NodeId>, CellHash> grid;
  for (std::size_t n = 0; n < reach.size(); ++n) {
    if (!seam[NodeId(n)]) continue;
    const Vec3 x = mesh.positions[NodeId(n)] - low, r = Vec3::Constant(cell);
    for_each_cell(cell_of(x - r, cell), cell_of(x + r, cell), [&](const Cell& c) {
      const auto found = grid.find(c);
      if (found == grid.end()) return;
      for (const NodeId m : found->second)
        if ((mesh.positions[m] - mesh.positions[NodeId(n)]).norm() <= std::min(reach[m], reach[NodeId(n)]))
          nodes.join(m.index(), n);
    });
    grid[cell_of(x, cell)].push_back(NodeId(n));
  }
}

}  // namespace

TriMesh welded(const TriMesh& mesh, WeldReport& report, std::vector<TriId>* kept, double share) {
  const std::vector<EdgeSide> sides = sides_by_edge(mesh);
  const IdVector<NodeId, double> reach = reaches(mesh, sides, share);
  UnionFind nodes(mesh.node_count());
  for_each_edge(sides, [&](auto begin, auto) {
    const Edge& e = begin->edge;
    if ((mesh.positions[e.a] - mesh.positions[e.b]).norm() <= std::min(reach[e.a], reach[e.b]))
      nodes.join(e.a.index(), e.b.index());
  });
  join_seams(mesh, reach, at_seam(mesh, sides), nodes);

  report = {};
  TriMesh out;
  out.positions = mesh.positions;
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (const std::size_t root = nodes.root(n); root != n) {
      ++report.nodes;
      report.farthest =
          std::max(report.farthest, (mesh.positions[NodeId(n)] - mesh.positions[NodeId(root)]).norm());
    }
  if (kept) kept->clear();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    auto c = mesh.corners[TriId(t)];
    for (NodeId& n : c)
      n = NodeId(nodes.root(n.index()));
    const bool collapsed = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
    if (collapsed && report.nodes > 0) {
      ++report.triangles;
      continue;
    }
    out.corners.push_back(c);
    if (kept) kept->push_back(TriId(t));
  }
  return out;
}

std::string WeldReport::text() const {
  return std::to_string(nodes) + " nodes were welded to others at most " + shortest(farthest) +
         " away, less than " + shortest(weld_share) + " of the edges there; " + std::to_string(triangles) +
         " triangles between them are gone";
}

AttributedMesh welded_if_it_helps(AttributedMesh surface, WeldReport& report) {
  report = {};
  const std::vector<MeshDefect> defects = find_defects(surface.mesh, 1);
  report.bounds_body = defects.empty();
  if (defects.empty() || std::any_of(defects.begin(), defects.end(), [](const MeshDefect& d) {
        return d.kind == DefectKind::index_out_of_range || d.kind == DefectKind::not_finite ||
               d.kind == DefectKind::empty;
      }))
    return surface;
  WeldReport weld;
  std::vector<TriId> kept;
  TriMesh mesh = welded(surface.mesh, weld, &kept);
  if (weld.nodes == 0) return surface;
  drop_unused_nodes(mesh);
  if (!find_defects(mesh, 1).empty()) return surface;
  report = weld;
  report.bounds_body = true;
  return {std::move(mesh), attributes_of(surface.attributes, kept)};
}

}  // namespace conchoid
