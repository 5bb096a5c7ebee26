#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Where the line between two neighbouring cells passes through a crack sheet.
struct SheetCrossing {
  std::size_t cell = 0;  ///< the lower one
  int axis = 0;          ///< from it to the upper one
  double depth = 0;      ///< share of the way from the lower cell to the upper one
  TriId triangle;        ///< of the sheet
  bool upwards = false;  ///< the upper cell lies on the side to which the triangle's normal points
};

/// Cells inside of a body that follow each other along the third axis, and their numbers: cell, cell + 1, … are
/// number, number + 1, …
struct CellRun {
  std::size_t cell = 0;
  std::int32_t number = 0, count = 0;
  std::int32_t end() const { return number + count; }
};

/// The same with what lies ahead of each along an axis: numbers ahead, ahead + 1, …
struct CellPairs : CellRun {
  std::int32_t ahead = 0;
};

/// The inside of a body as cubic cells, with the crack sheets as walls between neighbours. Two cells belong to
/// the same material exactly where a chain of neighbours leads from one to the other without a wall. The grid
/// lies in axes of the sheets, the first across them by their area tensor ∫ n nᵀ dA, all towards where in the body
/// they are: what it says turns, moves and is mirrored with the body. Cells count along the third axis first.
class CellGrid {
 public:
  /// @param body    closed, outward
  /// @param sheets  open; may stick out of the body
  /// @param size    edge of a cell [m]
  CellGrid(const TriMesh& body, const TriMesh& sheets, double size);

  double size() const { return size_; }
  const std::array<int, 3>& count() const { return count_; }
  std::size_t cells() const { return step_[0] * static_cast<std::size_t>(count_[0]); }
  std::size_t cell(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * count_[1] + j) * count_[2] + k;
  }
  /// The next cell along an axis; there must be one.
  std::size_t next(std::size_t cell, int axis) const { return cell + step_[axis]; }
  std::array<int, 3> place(std::size_t cell) const;
  Vec3 center(std::size_t cell) const;
  /// In the body's coordinates, from places counted in cells.
  Vec3 position(const Vec3& place) const { return origin_ + size_ * (axes_ * place); }
  Vec3 place_of(const Vec3& position) const { return axes_.transpose() * (position - origin_) / size_; }

  /// Calls found(first, end) for the cells first, …, end − 1 of each line along the third axis whose centres lie within
  /// `reach` cells of a place counted in cells.
  template <class Found>
  void for_lines_near(const Vec3& place, double reach, const Found& found) const {
    // Along an axis: the cells within a distance of the place.
    const auto range = [&](int a, double within) {
      return std::pair{std::max(static_cast<int>(std::ceil(place[a] - within)), 0),
                       std::min(static_cast<int>(std::floor(place[a] + within)), count_[a] - 1)};
    };
    const auto left = [](double within, double used) {
      return std::sqrt(std::max(0.0, within * within - used * used));
    };
    const auto [i0, i1] = range(0, reach);
    for (int i = i0; i <= i1; ++i) {
      const double across = left(reach, i - place[0]);
      const auto [j0, j1] = range(1, across);
      for (int j = j0; j <= j1; ++j) {
        const auto [k0, k1] = range(2, left(across, j - place[1]));
        if (k0 <= k1) found(cell(i, j, k0), cell(i, j, k1) + 1);
      }
    }
  }

  bool inside(std::size_t cell) const { return number(cell) >= 0; }
  /// How many cells are inside of the body: mostly few of those of its box. They are numbered in the order of their ids.
  std::size_t inside_count() const { return walls_.size(); }
  /// −1 outside of the body.
  std::int32_t number(std::size_t cell) const;
  /// All cells inside, in order.
  const std::vector<CellRun>& runs() const { return runs_; }
  /// Calls found(number, count) for those inside among the cells first, …, end − 1 of one line along the third axis.
  template <class Found>
  void for_inside(std::size_t first, std::size_t end, const Found& found) const {
    const std::size_t line = first / step_[1];
    for (std::size_t r = first_run_[line]; r < first_run_[line + 1]; ++r) {
      const CellRun& run = runs_[r];
      const std::size_t low = std::max(first, run.cell);
      const std::size_t high = std::min(end, run.cell + static_cast<std::size_t>(run.count));
      if (low < high)
        found(run.number + static_cast<std::int32_t>(low - run.cell), static_cast<std::int32_t>(high - low));
    }
  }
  /// All neighbours along an axis that are both inside, in order.
  const std::vector<CellPairs>& pairs(int axis) const { return pairs_[static_cast<std::size_t>(axis)]; }
  /// Whether nothing stands between a cell inside, by its number, and the one ahead along an axis.
  bool open(std::size_t number, int axis) const { return (walls_[number] & 1U << axis) == 0; }

  /// Numbers of the cells inside as numbers of all cells, 0 outside.
  template <class Number>
  std::vector<Number> by_cell(const std::vector<Number>& of_inside) const {
    std::vector<Number> all(cells(), 0);
    for (const CellRun& run : runs_)
      std::copy_n(of_inside.begin() + run.number, run.count,
                  all.begin() + static_cast<std::ptrdiff_t>(run.cell));
    return all;
  }

  /// By cell, axis, then depth.
  const std::vector<SheetCrossing>& crossings() const { return crossings_; }

 private:
  /// Positions of a mesh's nodes counted in cells.
  std::vector<Vec3> places(const TriMesh& mesh) const;
  /// Calls found(cell, depth, triangle, upwards) wherever lines of cells along `axis` cross the mesh; cells
  /// outside of the grid are left out, their lines are not.
  template <class Found>
  void cross(const TriMesh& mesh, const std::vector<Vec3>& places, int axis, const Found& found) const;
  /// @param surface  cells before the body's surface along the third axis
  void list_runs(const std::vector<std::size_t>& surface);
  /// @param surface, cracks  what stands before the next cell along each axis
  void stand_walls(const std::array<std::vector<std::size_t>, 3>& surface,
                   const std::array<std::vector<SheetCrossing>, 3>& cracks);
  void list_pairs();

  double size_;
  Mat3 axes_;  // columns; perhaps left-handed
  Vec3 origin_;
  std::array<int, 3> count_{};
  std::array<std::size_t, 3> step_{};
  std::vector<CellRun> runs_;
  std::vector<std::uint32_t> first_run_;  // of each line of cells along the third axis, and one more
  std::array<std::vector<CellPairs>, 3> pairs_;
  std::vector<std::uint8_t>
      walls_;  // by number: bit 0, 1, 2 for something between it and the next one along an axis
  std::vector<SheetCrossing> crossings_;
};

}  // namespace conchoid
