#include "conchoid/intersect/plane_cover.hpp"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/plane_signs.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

// A sheet seen along an axis.
struct View {
  Projection projection;
  int side;  // sign of the turn of most triangles
};

View best_view(const TriMesh& sheet) {
  Vec3 area = Vec3::Zero();
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    area += area_vector(sheet, TriId(t));
  Eigen::Index axis = 0;
  area.cwiseAbs().maxCoeff(&axis);
  const int along = static_cast<int>(axis);
  return {{(along + 1) % 3, (along + 2) % 3}, area[axis] > 0 ? 1 : -1};
}

bool seen_from_one_side(const TriMesh& sheet, const View& view) {
  std::atomic<bool> all = true;
  parallel_for(sheet.triangle_count(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end && all; ++t) {
      const Triangle x = sheet.triangle(TriId(t));
      if (turn(x[0], x[1], x[2], view.projection) != view.side) all = false;
    }
  });
  return all;
}

// From a node of a boundary to the next.
struct DirectedEdge {
  NodeId from, to;
};

// None where a node is on them twice.
std::optional<std::vector<DirectedEdge>> edges_of(const std::vector<BoundaryLoop>& loops,
                                                  std::size_t node_count) {
  IdVector<NodeId, char> seen(node_count, 0);
  std::vector<DirectedEdge> edges;
  for (const BoundaryLoop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (std::exchange(seen[loop[i]], 1) != 0) return std::nullopt;
      edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
    }
  return edges;
}

// Of a closed curve without crossings: the sign of the turn at its outermost node.
int way_round(const TriMesh& sheet, const BoundaryLoop& loop, Projection pr) {
  const auto x = [&](std::size_t i) -> const Vec3& { return sheet.positions[loop[i % loop.size()]]; };
  std::size_t first = 0;
  for (std::size_t i = 1; i < loop.size(); ++i)
    if (x(i)[pr.p] != x(first)[pr.p] ? x(i)[pr.p] < x(first)[pr.p] : x(i)[pr.q] < x(first)[pr.q]) first = i;
  return turn(x(first + loop.size() - 1), x(first), x(first + 1), pr);
}

// Whether two edges of the boundary have a point in common that is no node of both.
bool meet(const TriMesh& sheet, const DirectedEdge& e, const DirectedEdge& f, Projection pr) {
  const auto x = [&](NodeId n) -> const Vec3& { return sheet.positions[n]; };
  if (e.to == f.from || f.to == e.from) {
    const auto& [first, second] = e.to == f.from ? std::pair(e, f) : std::pair(f, e);
    return turn(x(first.from), x(first.to), x(second.to), pr) == 0 &&
           (between(x(second.to), x(first.from), x(first.to), pr) ||
            between(x(first.from), x(second.from), x(second.to), pr));
  }
  return coplanar_segments_meet(x(e.from), x(e.to), x(f.from), x(f.to), pr);
}

bool boundaries_meet(const TriMesh& sheet, const std::vector<DirectedEdge>& boundary, Projection pr) {
  std::vector<Box> boxes;
  for (const DirectedEdge& e : boundary) {
    Vec3 a = Vec3::Zero(), b = a;
    for (const int k : {pr.p, pr.q}) {
      a[k] = sheet.positions[e.from][k];
      b[k] = sheet.positions[e.to][k];
    }
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    bool met = false;
    tree.visit_overlapping(boxes[i], [&](TriId near) {
      met = met || (near.index() < i && meet(sheet, boundary[i], boundary[near.index()], pr));
    });
    if (met) return true;
  }
  return false;
}

}  // namespace

bool covers_plane_once(const TriMesh& sheet) {
  if (sheet.corners.empty()) return false;
  const View view = best_view(sheet);
  if (!seen_from_one_side(sheet, view)) return false;
  const std::vector<BoundaryLoop> loops = boundary_loops(sheet);
  const auto boundary = edges_of(loops, sheet.node_count());
  if (!boundary || boundaries_meet(sheet, *boundary, view.projection)) return false;
  return std::count_if(loops.begin(), loops.end(), [&](const BoundaryLoop& loop) {
           return way_round(sheet, loop, view.projection) == view.side;
         }) == 1;
}

}  // namespace conchoid
