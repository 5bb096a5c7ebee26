#include "conchoid/remesh/inner_walls.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "conchoid/core/union_find.hpp"
#include "conchoid/remesh/edge_sides.hpp"

namespace conchoid {
namespace {

/// A region of space next to a surface.
struct SpaceCell {
  double volume = 0;     ///< negative: outside [m³]
  double area = 0;       ///< of the triangles around it [m²]
  double seen_from = 0;  ///< area of those whose normals look into it [m²]
  bool outside = false;
};

/// Side 2t is the one that the normal of triangle t looks to, 2t + 1 the other.
class SpaceCells {
 public:
  explicit SpaceCells(const TriMesh& mesh)
      : mesh_(mesh), sides_(2 * mesh.triangle_count()), parts_(mesh.triangle_count()) {
    const std::vector<EdgeSide> sides = sides_by_edge(mesh);
    crowded_.assign(mesh.triangle_count(), 0);
    std::vector<TriId> at_crowded;
    for_each_edge(sides, [&](auto begin, auto end) {
      const std::vector<EdgeSide> around = around_edge(mesh, {begin, end});
      for (std::size_t i = 0; i < around.size(); ++i) {
        const EdgeSide &now = around[i], &next = around[(i + 1) % around.size()];
        // forward triangles look the way the plane turns
        sides_.join(side(now, true), side(next, false));
        parts_.join(now.triangle.index(), next.triangle.index());
        if (around.size() > 2) at_crowded.push_back(now.triangle);
      }
    });
    for (const TriId t : at_crowded)
      crowded_[parts_.root(t.index())] = 1;
    measure();
  }

  bool in_crowded_part(TriId t) { return crowded_[parts_.root(t.index())] != 0; }
  /// Whether a cell of the triangle's part has holes to the outside, so that nothing can be said.
  bool outside(TriId t, bool in_front) {
    return cells_[sides_.root(2 * t.index() + (in_front ? 0 : 1))].outside;
  }
  bool has_inside(TriId t) { return has_inside_[parts_.root(t.index())] != 0; }

 private:
  static std::size_t side(const EdgeSide& s, bool ahead) {
    return 2 * s.triangle.index() + (s.forward == ahead ? 0 : 1);
  }

  void measure() {
    const Vec3 center = bounding_box(mesh_).center();
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const Triangle x = mesh_.triangle(TriId(t));
      const double volume = (x[0] - center).dot(cross(x[1] - center, x[2] - center)) / 6;
      const double area = area_vector(mesh_, TriId(t)).norm();
      SpaceCell &front = cells_[sides_.root(2 * t)], &back = cells_[sides_.root(2 * t + 1)];
      front.volume -= volume;
      back.volume += volume;
      front.area += area;
      back.area += area;
      front.seen_from += area;
    }
    // the unbounded cell of each part is the one with the least volume
    std::map<std::size_t, std::size_t> outer;
    for (std::size_t s = 0; s < 2 * mesh_.triangle_count(); ++s) {
      const std::size_t root = sides_.root(s);
      const auto [found, is_new] = outer.try_emplace(parts_.root(s / 2), root);
      if (!is_new && cells_[root].volume < cells_[found->second].volume) found->second = root;
    }
    std::map<std::size_t, char> beside_outer;
    for (std::size_t s = 0; s < 2 * mesh_.triangle_count(); ++s)
      if (sides_.root(s) == outer[parts_.root(s / 2)]) beside_outer[sides_.root(s ^ 1)] = 1;
    constexpr double all = 0.999;
    for (auto& [root, cell] : cells_)
      cell.outside = outer[parts_.root(root / 2)] == root ||
                     (!beside_outer.contains(root) && cell.seen_from > all * cell.area);
    has_inside_.assign(mesh_.triangle_count(), 0);
    for (const auto& [root, cell] : cells_)
      if (!cell.outside) has_inside_[parts_.root(root / 2)] = 1;
  }

  const TriMesh& mesh_;
  UnionFind sides_, parts_;
  std::vector<char> crowded_, has_inside_;
  std::map<std::size_t, SpaceCell> cells_;
};

}  // namespace

std::size_t drop_inner_walls(TriMesh& mesh) {
  SpaceCells cells(mesh);
  IdVector<TriId, std::array<NodeId, 3>> kept;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const TriId t(i);
    std::array<NodeId, 3> c = mesh.corners[t];
    if (cells.in_crowded_part(t) && cells.has_inside(t)) {
      const bool front = cells.outside(t, true), back = cells.outside(t, false);
      if (front == back) continue;
      if (back) std::swap(c[1], c[2]);
    }
    kept.push_back(c);
  }
  const std::size_t dropped = mesh.triangle_count() - kept.size();
  mesh.corners = std::move(kept);
  return dropped;
}

}  // namespace conchoid
