#include "conchoid/crack/closing/last_ligament.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/closing/cell_sets.hpp"
#include "conchoid/crack/length_factors.hpp"
#include "conchoid/mesh/box.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kEndsForABound = 500;  // of a half width

double cell_size(const TriMesh& body, double target_edge) {
  const Box box = bounding_box(body);
  const double volume = std::abs((box.high - box.low).prod());
  return std::max(target_edge / kCellsPerEdge, std::cbrt(volume / kMostCells));
}

// The cell around a place; none beyond the grid.
std::optional<std::size_t> cell_at(const CellGrid& grid, const Vec3& place) {
  std::array<int, 3> at{};
  for (int a = 0; a < 3; ++a) {
    at[a] = static_cast<int>(std::lround(place[a]));
    if (at[a] < 0 || at[a] >= grid.count()[a]) return std::nullopt;
  }
  return grid.cell(at[0], at[1], at[2]);
}

// Per cell inside whether it is within kLigamentBand of the cracks' ends inside of the body.
std::vector<std::uint8_t> cells_near_fronts(const CellGrid& grid, const TriMesh& sheets,
                                            const std::vector<Edge>& ends, double target_edge) {
  std::vector<std::uint8_t> band(grid.inside_count(), 0);
  std::vector<bool> done(grid.inside_count(), false);
  const double reach = kLigamentBand * target_edge / grid.size();
  for (const Edge& e : ends) {
    const Vec3 x = grid.place_of(0.5 * (sheets.positions[e.a] + sheets.positions[e.b]));
    const auto cell = cell_at(grid, x);
    const std::int32_t here = cell ? grid.number(*cell) : -1;
    if (here < 0 || done[static_cast<std::size_t>(here)]) continue;
    done[static_cast<std::size_t>(here)] = true;
    grid.for_lines_near(x, reach, [&](std::size_t first, std::size_t end) {
      grid.for_inside(first, end, [&](std::int32_t number, std::int32_t count) {
        std::memset(band.data() + number, 1, static_cast<std::size_t>(count));
      });
    });
  }
  return band;
}

// Cells of a side that hang together, over walls too, but are too few for a part, go over to the other side where it is
// beside them: nothing would come off there. Where nothing is beside them, they go with most of the body.
void remove_specks(const CellGrid& grid, std::vector<std::int8_t>& side) {
  const CellSets sets =
      sets_of_cells(grid, [&](std::size_t i, int, std::size_t next) { return side[i] == side[next]; });
  struct Set {
    std::int32_t cells = 0;
    std::int8_t side = 0;
    bool alone = true;
    bool is_speck() const { return cells < kFewestCells; }
  };
  std::vector<Set> of(static_cast<std::size_t>(sets.count));
  for (const CellSets::Chain& chain : sets.chains) {
    Set& set = of[static_cast<std::size_t>(chain.set)];
    set.cells += chain.size();
    set.side = side[static_cast<std::size_t>(chain.first)];
  }
  if (std::none_of(of.begin(), of.end(), [](const Set& set) { return set.is_speck(); })) return;
  const auto part = [&](std::size_t cell) -> Set& {
    return of[static_cast<std::size_t>(sets.of_cell[cell])];
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const CellPairs& pairs : grid.pairs(axis))
      for (std::int32_t k = 0; k < pairs.count; ++k) {
        const auto i = static_cast<std::size_t>(pairs.number + k),
                   n = static_cast<std::size_t>(pairs.ahead + k);
        if (side[i] != side[n]) part(i).alone = part(n).alone = false;
      }
  std::ptrdiff_t more_above = 0;
  for (const Set& set : of)
    if (!set.is_speck()) more_above += set.side > 0 ? set.cells : -set.cells;
  for (Set& set : of)
    if (set.is_speck()) set.side = static_cast<std::int8_t>(!set.alone ? -set.side : more_above > 0 ? 1 : -1);
  for (const CellSets::Chain& chain : sets.chains)
    if (const Set& set = of[static_cast<std::size_t>(chain.set)]; set.is_speck())
      std::fill(side.begin() + chain.first, side.begin() + chain.end, set.side);
}

// In the order of their cells.
std::vector<Vec3> broken_faces(const CellGrid& grid, const CellPartition& partition,
                               const std::vector<std::uint8_t>& band) {
  std::vector<std::array<std::size_t, 2>> cells;
  for_faces_in_band(grid, band, [&](std::size_t i, std::size_t next, std::size_t cell, int axis) {
    if (partition.side[i] != partition.side[next]) cells.push_back({cell, grid.next(cell, axis)});
  });
  std::sort(cells.begin(), cells.end());
  std::vector<Vec3> faces;
  faces.reserve(cells.size());
  for (const auto& [cell, next] : cells)
    faces.push_back(0.5 * (grid.center(cell) + grid.center(next)));
  return faces;
}

// Largest distance of the broken faces from the walls: few faces, while the walls are many.
double half_width(const std::vector<Vec3>& faces, const TriMesh& body, const TriMesh& sheets,
                  const std::vector<Edge>& ends) {
  if (faces.empty()) return 0;
  // It is no more than that from some of the cracks' ends.
  const std::size_t stride = ends.size() / kEndsForABound + 1;
  Box box{faces[0], faces[0]};
  double squared_bound = 0;
  for (const Vec3& x : faces) {
    box = united(box, {x, x});
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ends.size(); i += stride)
      nearest = std::min(nearest, (sheets.positions[ends[i].a] - x).squaredNorm());
    squared_bound = std::max(squared_bound, nearest);
  }
  const double reach = std::sqrt(squared_bound);
  box = grown(box, reach);
  const ClosestPointTree tree(join({part_within(box, body), part_within(box, sheets)}));
  double squared = 0;
  for (const Vec3& x : faces)
    squared = std::max(squared, std::min(tree.closest(x).squared_distance, squared_bound));
  return std::sqrt(squared);
}

// None where it parts off too little.
std::optional<LastLigament> ligament_of(std::shared_ptr<const CellGrid> grid, CellPartition partition,
                                        const TriMesh& body, const TriMesh& sheets,
                                        const std::vector<Edge>& ends,
                                        const std::vector<std::uint8_t>& band) {
  remove_specks(*grid, partition.side);
  const std::ptrdiff_t upper = std::count(partition.side.begin(), partition.side.end(), 1);
  const std::ptrdiff_t smaller = std::min(upper, static_cast<std::ptrdiff_t>(partition.side.size()) - upper);
  if (smaller < kFewestCells) return std::nullopt;
  LastLigament out;
  out.grid = std::move(grid);
  out.partition = std::move(partition);
  out.faces = broken_faces(*out.grid, out.partition, band);
  out.half_width = half_width(out.faces, body, sheets, ends);
  out.smaller_part = std::pow(out.grid->size(), 3) * static_cast<double>(smaller);
  return out;
}

}  // namespace

std::vector<LastLigament> find_last_ligaments(const TriMesh& body, const TriMesh& sheets, double target_edge,
                                              LigamentsOf of) {
  if (sheets.corners.empty()) return {};
  const auto grid = std::make_shared<const CellGrid>(body, sheets, cell_size(body, target_edge));
  const std::vector<Edge> ends = boundary_edges(sheets);
  const std::vector<std::uint8_t> band = cells_near_fronts(*grid, sheets, ends, target_edge);
  const std::vector<int> part = connected_parts(sheets);
  std::vector<LastLigament> found;
  const std::size_t parts = static_cast<std::size_t>(*std::max_element(part.begin(), part.end())) + 1;
  const bool together = parts > 1 && of == LigamentsOf::each_and_all;
  std::vector<CellPartition> cuts = parallel_values(parts + (together ? 1 : 0), 1, [&](std::size_t p) {
    std::vector<bool> crack(sheets.triangle_count());
    for (std::size_t t = 0; t < crack.size(); ++t)
      crack[t] = p == parts || part[sheets.corners[TriId(t)][0].index()] == static_cast<int>(p);
    return minimal_cut(*grid, crack, band);
  });
  for (CellPartition& cut : cuts)
    if (auto ligament = ligament_of(grid, std::move(cut), body, sheets, ends, band))
      found.push_back(*std::move(ligament));
  std::stable_sort(found.begin(), found.end(),
                   [](const LastLigament& x, const LastLigament& y) { return x.half_width < y.half_width; });
  return found;
}

std::optional<LastLigament> find_same_ligament(const TriMesh& body, const TriMesh& sheets, double target_edge,
                                               const LastLigament& elsewhere) {
  if (sheets.corners.empty()) return std::nullopt;
  const auto grid = std::make_shared<const CellGrid>(body, sheets, cell_size(body, target_edge));
  const std::vector<Edge> ends = boundary_edges(sheets);
  const std::vector<std::uint8_t> band = cells_near_fronts(*grid, sheets, ends, target_edge);
  const std::vector<std::int8_t> sides = elsewhere.grid->by_cell(elsewhere.partition.side);
  std::vector<std::int8_t> known(grid->inside_count(), 0);
  parallel_for(grid->runs().size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const CellRun& run = grid->runs()[r];
      for (std::int32_t k = 0; k < run.count; ++k) {
        const auto i = static_cast<std::size_t>(run.number + k);
        if (band[i]) continue;
        const Vec3 x = grid->center(run.cell + static_cast<std::size_t>(k));
        if (const auto there = cell_at(*elsewhere.grid, elsewhere.grid->place_of(x)))
          known[i] = sides[*there];
      }
    }
  });
  const std::vector<bool> all(sheets.triangle_count(), true);
  return ligament_of(grid, minimal_cut(*grid, all, band, known), body, sheets, ends, band);
}

}  // namespace conchoid
