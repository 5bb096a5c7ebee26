#pragma once

#include <array>
#include <cstdint>
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

/// A cell inside of a body, and its neighbours.
struct InsideCell {
  std::uint32_t cell = 0;
  /// Along each axis, as a place among the cells inside; −1 outside.
  std::array<std::int32_t, 3> next{-1, -1, -1};
  /// Axes along which something stands between this cell and the next one: bit 0, 1, 2.
  std::uint8_t walls = 0;

  bool open(int axis) const { return (walls & 1U << axis) == 0; }
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
  std::size_t cells() const { return inside_.size(); }
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

  /// The cells whose centres lie within `reach` cells of a place counted in cells.
  void mark_near(const Vec3& place, double reach, std::vector<bool>& near) const;

  bool inside(std::size_t cell) const { return inside_[cell] != 0; }
  /// The cells inside of the body, by their ids: mostly few of those of its box.
  const std::vector<InsideCell>& inside_cells() const { return inside_cells_; }
  /// The place of a cell among these; −1 outside of the body.
  std::int32_t number(std::size_t cell) const;

  /// Numbers of the cells inside as numbers of all cells, 0 outside.
  template <class Number>
  std::vector<Number> by_cell(const std::vector<Number>& of_inside) const {
    std::vector<Number> all(cells(), 0);
    for (std::size_t i = 0; i < of_inside.size(); ++i)
      all[inside_cells_[i].cell] = of_inside[i];
    return all;
  }

  /// Whether a crack, not the body's surface alone, stands between the two.
  bool cracked(std::size_t cell, int axis) const { return (wall_[cell] & kSheet << axis) != 0; }
  /// By cell, axis, then depth.
  const std::vector<SheetCrossing>& crossings() const { return crossings_; }

 private:
  static constexpr unsigned kSurface = 1, kSheet = 8;  // shifted by the axis

  /// Positions of a mesh's nodes counted in cells.
  std::vector<Vec3> places(const TriMesh& mesh) const;
  /// Calls found(cell, depth, triangle, upwards) wherever lines of cells along `axis` cross the mesh; cells
  /// outside of the grid are left out, their lines are not.
  template <class Found>
  void cross(const TriMesh& mesh, const std::vector<Vec3>& places, int axis, const Found& found) const;
  void stand_walls(const TriMesh& body, const TriMesh& sheets);
  void list_inside_cells();

  double size_;
  Mat3 axes_;  // columns; perhaps left-handed
  Vec3 origin_;
  std::array<int, 3> count_{};
  std::array<std::size_t, 3> step_{};
  std::vector<std::uint8_t> inside_, wall_;
  std::vector<InsideCell> inside_cells_;
  std::vector<SheetCrossing> crossings_;
};

}  // namespace conchoid
