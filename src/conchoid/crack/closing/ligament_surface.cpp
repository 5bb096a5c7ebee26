#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/closing/last_ligament.hpp"
#include "conchoid/crack/length_factors.hpp"
#include "conchoid/mesh/box.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

using Link = std::pair<std::size_t, std::size_t>;  // of two cells: of the upper side, of the lower side

// Six tetrahedra of a cube of cells, all about one diagonal, the same in every cube: faces of neighbours fit.
// Corner bits: 1, 2, 4 for a step along axis 0, 1, 2.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

// Where a → b passes through the triangle, as a share of the way; none if it does not.
std::optional<double> passes(const Vec3& a, const Vec3& b, const Triangle& x) {
  const Vec3 n = area_vector2(x[0], x[1], x[2]);
  const double along = n.dot(b - a);
  if (along == 0) return std::nullopt;
  const double s = n.dot(x[0] - a) / along;
  if (s < 0 || s > 1) return std::nullopt;
  const Vec3 y = a + s * (b - a);
  for (int k = 0; k < 3; ++k)
    if (n.dot(cross(x[(k + 1) % 3] - x[k], y - x[k])) < 0) return std::nullopt;
  return s;
}

// Visits the neighbours of a cell, with weights that fall with the distance.
template <class Visit>
void for_neighbours(const CellGrid& grid, std::size_t cell, const Visit& visit) {
  const auto at = grid.place(cell);
  const auto in_grid = [&](const std::array<int, 3>& to) {
    for (int a = 0; a < 3; ++a)
      if (to[a] < 0 || to[a] >= grid.count()[a]) return false;
    return true;
  };
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        const std::array<int, 3> to{at[0] + i, at[1] + j, at[2] + k};
        if ((i != 0 || j != 0 || k != 0) && in_grid(to))
          visit(grid.cell(to[0], to[1], to[2]), 4 - std::abs(i) - std::abs(j) - std::abs(k));
      }
}

// Cells inside of the body with a neighbour along an axis that is not.
std::vector<std::size_t> rim_of(const CellGrid& grid) {
  std::vector<std::uint8_t> neighbours(grid.inside_count(), 0);
  for (int axis = 0; axis < 3; ++axis)
    for (const CellPairs& pairs : grid.pairs(axis))
      for (std::int32_t k = 0; k < pairs.count; ++k) {
        ++neighbours[static_cast<std::size_t>(pairs.number + k)];
        ++neighbours[static_cast<std::size_t>(pairs.ahead + k)];
      }
  std::vector<std::size_t> rim;
  for (const CellRun& run : grid.runs())
    for (std::int32_t k = 0; k < run.count; ++k)
      if (neighbours[static_cast<std::size_t>(run.number + k)] < 6)
        rim.push_back(run.cell + static_cast<std::size_t>(k));
  return rim;
}

// Sides of all cells, those around the body as those next to them inside.
std::vector<std::int8_t> spread_outside(const CellGrid& grid, const std::vector<std::int8_t>& of_inside) {
  constexpr std::int8_t reached = 2;
  std::vector<std::int8_t> side = grid.by_cell(of_inside);
  std::vector<std::size_t> rim = rim_of(grid);
  for (int round = 0; round < kCellsOutside; ++round) {
    std::vector<std::size_t> outer;
    for (const std::size_t c : rim)
      for_neighbours(grid, c, [&](std::size_t d, int) {
        if (side[d] != 0) return;
        side[d] = reached;
        outer.push_back(d);
      });
    const auto sides = parallel_values(outer.size(), 4096, [&](std::size_t i) -> std::int8_t {
      int sum = 0;
      for_neighbours(grid, outer[i], [&](std::size_t d, int weight) {
        if (side[d] != reached) sum += weight * side[d];
      });
      return sum >= 0 ? 1 : -1;
    });
    for (std::size_t i = 0; i < outer.size(); ++i)
      side[outer[i]] = sides[i];
    rim = std::move(outer);
  }
  return side;
}

class SurfaceMaker {
 public:
  SurfaceMaker(const LastLigament& ligament, const TriMesh& sheets, const std::vector<std::int8_t>& side)
      : grid_(*ligament.grid), ligament_(ligament), sheets_(sheets), side_(side) {}

  TriMesh over_ends(const LigamentOverlap& overlap) {
    near_.assign(grid_.cells(), false);
    const auto mark_near = [&](const Vec3& x) {
      grid_.for_lines_near(grid_.place_of(x), overlap.cells, [&](std::size_t first, std::size_t end) {
        std::fill(near_.begin() + static_cast<std::ptrdiff_t>(first),
                  near_.begin() + static_cast<std::ptrdiff_t>(end), true);
      });
    };
    for (const Vec3& x : ligament_.faces)
      mark_near(x);
    // Wherever the cracks that part the two sides end: there they may not quite reach each other.
    for (const Edge& e : boundary_edges(sheets_))
      mark_near(0.5 * (sheets_.positions[e.a] + sheets_.positions[e.b]));
    march();
    place(overlap.offset);
    smooth(kSmoothingRounds);
    return std::move(mesh_);
  }

  TriMesh everywhere(const DividingSurface& how) {
    near_.assign(grid_.cells(), true);
    march();
    place(0);
    smooth(how.smoothing);
    if (how.halved) halve();
    return std::move(mesh_);
  }

 private:
  // Marching tetrahedra between the two sides, from the lower to the upper.
  void march() {
    for (std::size_t c = 0; c < grid_.cells(); ++c) {
      if (!near_[c]) continue;
      const auto at = grid_.place(c);
      if (at[0] + 1 >= grid_.count()[0] || at[1] + 1 >= grid_.count()[1] || at[2] + 1 >= grid_.count()[2])
        continue;
      std::array<std::size_t, 8> corner{};
      bool known = true;
      int sum = 0;
      for (int k = 0; k < 8; ++k) {
        corner[k] = grid_.cell(at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2 & 1));
        known = known && near_[corner[k]] && side_[corner[k]] != 0;
        sum += side_[corner[k]];
      }
      if (!known || std::abs(sum) == 8) continue;
      for (const auto& t : kTetrahedra)
        cut_tetrahedron({corner[t[0]], corner[t[1]], corner[t[2]], corner[t[3]]});
    }
  }

  NodeId node(std::size_t upper, std::size_t lower) {
    const auto [at, is_new] = nodes_.try_emplace(Link{upper, lower});
    if (is_new) {
      at->second = mesh_.positions.add(0.5 * (grid_.center(upper) + grid_.center(lower)));
      links_.push_back({upper, lower});
    }
    return at->second;
  }

  void add(NodeId a, NodeId b, NodeId c, const Vec3& up) {
    const auto& x = mesh_.positions;
    if (area_vector2(x[a], x[b], x[c]).dot(up) < 0) std::swap(b, c);
    mesh_.corners.push_back({a, b, c});
  }

  void cut_tetrahedron(const std::array<std::size_t, 4>& cells) {
    std::vector<std::size_t> upper, lower;
    Vec3 up = Vec3::Zero();
    for (const std::size_t c : cells)
      (side_[c] > 0 ? upper : lower).push_back(c);
    if (upper.empty() || lower.empty()) return;
    for (const std::size_t c : upper)
      up += grid_.center(c) / static_cast<double>(upper.size());
    for (const std::size_t c : lower)
      up -= grid_.center(c) / static_cast<double>(lower.size());
    if (upper.size() == 2) {
      const NodeId a = node(upper[0], lower[0]), b = node(upper[0], lower[1]);
      const NodeId c = node(upper[1], lower[1]), d = node(upper[1], lower[0]);
      add(a, b, c, up);
      add(a, c, d, up);
    } else if (upper.size() == 1) {
      add(node(upper[0], lower[0]), node(upper[0], lower[1]), node(upper[0], lower[2]), up);
    } else {
      add(node(upper[0], lower[0]), node(upper[1], lower[0]), node(upper[2], lower[0]), up);
    }
  }

  // Near the surface: it is little of what the sheets are, as a rule.
  void find_cracks() {
    cracks_ = part_within(grown(bounding_box(mesh_), 2 * grid_.size()), sheets_);
    tree_.emplace(cracks_);
  }

  // Nodes between cells that a crack parts lie beside it, on its upper side; towards the rim of the surface they
  // go over to the other: so it crosses the crack there. @param offset  × cell
  void place(double offset) {
    find_cracks();
    on_rim_.assign(mesh_.node_count(), false);
    for (const Edge& e : boundary_edges(mesh_))
      on_rim_[e.a.index()] = on_rim_[e.b.index()] = true;
    const std::vector<double> from_rim = cells_from_rim();
    across_.assign(mesh_.node_count(), Vec3::Zero());
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Vec3 upper = grid_.center(links_[i].first), lower = grid_.center(links_[i].second);
      const std::optional<Crossing> crack = crossing(lower, upper);
      if (!crack) continue;
      across_[i] = crack->normal;
      const double share = std::clamp(2 * from_rim[i] / kCrossingCells - 1, -1.0, 1.0);
      mesh_.positions[NodeId(i)] =
          lower + crack->depth * (upper - lower) + share * offset * grid_.size() * crack->normal;
    }
  }

  // Where a → b passes through a crack: that nearest to the middle. The normal points along.
  struct Crossing {
    double depth;
    Vec3 normal;
  };
  std::optional<Crossing> crossing(const Vec3& a, const Vec3& b) const {
    std::optional<Crossing> best;
    for (const TriId t : tree_->overlapping({a.cwiseMin(b), a.cwiseMax(b)}))
      if (const auto s = passes(a, b, cracks_.triangle(t));
          s && (!best || std::abs(*s - 0.5) < std::abs(best->depth - 0.5)))
        best = {*s, unit_normal(cracks_, t)};
    if (best && best->normal.dot(b - a) < 0) best->normal *= -1;
    return best;
  }

  // Every edge, the new nodes between two beside a crack on it.
  void halve() {
    std::map<Edge, NodeId> middles;
    const auto middle = [&](NodeId a, NodeId b) {
      const auto [at, is_new] = middles.try_emplace(Edge(a, b));
      if (!is_new) return at->second;
      Vec3 x = 0.5 * (mesh_.positions[a] + mesh_.positions[b]);
      const Vec3 reach = 0.25 * grid_.size() * (across_[a.index()] + across_[b.index()]);
      if (!across_[a.index()].isZero(0) && !across_[b.index()].isZero(0))
        if (const auto crack = crossing(x - reach, x + reach)) x += (2 * crack->depth - 1) * reach;
      return at->second = mesh_.positions.add(x);
    };
    TriMesh halves;
    for (const auto& [a, b, c] : mesh_.corners) {
      const NodeId d = middle(a, b), e = middle(b, c), f = middle(c, a);
      for (const auto& corners :
           {std::array{a, d, f}, std::array{d, b, e}, std::array{f, e, c}, std::array{d, e, f}})
        halves.corners.push_back(corners);
    }
    mesh_.corners = std::move(halves.corners);
  }

  // Up to kCrossingCells, before anything is placed.
  std::vector<double> cells_from_rim() const {
    std::vector<double> cells(mesh_.node_count(), kCrossingCells);
    TriMesh line;  // needles along the rim, for the tree
    for (const Edge& e : boundary_edges(mesh_)) {
      const NodeId a = line.positions.add(mesh_.positions[e.a]), b = line.positions.add(mesh_.positions[e.b]);
      line.corners.push_back({a, b, b});
    }
    const ClosestPointTree tree(line);
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i] = std::min(
          cells[i], std::sqrt(tree.closest(mesh_.positions[NodeId(i)]).squared_distance) / grid_.size());
    return cells;
  }

  // To the middle of their neighbours: nodes beside a crack along it, those on the rim across the surface.
  void smooth(int rounds) {
    std::vector<std::set<NodeId>> around(mesh_.node_count());
    for (const auto& c : mesh_.corners)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (k != l) around[c[k].index()].insert(c[l]);
    for (int round = 0; round < rounds; ++round) {
      const IdVector<NodeId, Vec3> before = mesh_.positions;
      IdVector<NodeId, Vec3> normals(mesh_.node_count(), Vec3::Zero());
      for (const auto& c : mesh_.corners)
        for (const NodeId n : c)
          normals[n] += area_vector2(before[c[0]], before[c[1]], before[c[2]]);
      for (std::size_t i = 0; i < around.size(); ++i) {
        const bool beside = !across_[i].isZero(0);
        if (around[i].empty() || (beside && (on_rim_[i] || round >= kSlidingRounds))) continue;
        Vec3 middle = Vec3::Zero();
        for (const NodeId n : around[i])
          middle += before[n] / static_cast<double>(around[i].size());
        Vec3 step = middle - before[NodeId(i)];
        if (beside) {
          step -= step.dot(across_[i]) * across_[i];
        } else if (on_rim_[i]) {
          const Vec3 n = normals[NodeId(i)].normalized();
          step = step.dot(n) * n;
        }
        mesh_.positions[NodeId(i)] += step;
      }
    }
  }

  const CellGrid& grid_;
  const LastLigament& ligament_;
  const TriMesh& sheets_;
  const std::vector<std::int8_t>& side_;
  std::vector<bool> near_, on_rim_;
  TriMesh cracks_;  // what of the sheets is near
  std::optional<BoxTree> tree_;
  std::vector<Vec3> across_;  // normal of the crack a node lies beside; zero for the others
  std::map<Link, NodeId> nodes_;
  std::vector<Link> links_;
  TriMesh mesh_;
};

}  // namespace

TriMesh ligament_surface(const LastLigament& ligament, const TriMesh& sheets,
                         const LigamentOverlap& overlap) {
  return LigamentSurfaces(ligament, sheets).with(overlap);
}

LigamentSurfaces::LigamentSurfaces(const LastLigament& ligament, const TriMesh& sheets)
    : ligament_(ligament), sheets_(sheets), side_(spread_outside(*ligament.grid, ligament.partition.side)) {}

TriMesh LigamentSurfaces::with(const LigamentOverlap& overlap) const {
  return SurfaceMaker(ligament_, sheets_, side_).over_ends(overlap);
}

TriMesh LigamentSurfaces::between_sides(const DividingSurface& how) const {
  return SurfaceMaker(ligament_, sheets_, side_).everywhere(how);
}

}  // namespace conchoid
