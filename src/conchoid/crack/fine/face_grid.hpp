#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "conchoid/core/cells.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Triangles of a growing sheet by the cells of a grid they lie in: what a short path runs into is found in a
/// time that does not depend on how large the sheet is.
class FaceGrid {
 public:
  /// @param cell  edge of a cell [m]; best about the longest edge of the triangles
  explicit FaceGrid(double cell) : cell_(cell) {}

  /// Takes in the next triangle of the mesh. @param part  it belongs to
  void take(const TriMesh& mesh, TriId t, int part);

  /// Two parts become one.
  void join(int part, int with);

  struct Hit {
    TriId triangle;
    int part;
    double fraction;  ///< of the path, 0 … 1
  };
  /// First triangle that the path from → to passes through at more than kGrazingSine to its plane and that has
  /// none of the nodes of `own`, sorted. Of triangles met at the same place the one with the lowest id.
  std::optional<Hit> first_hit(const TriMesh& mesh, const Vec3& from, const Vec3& to,
                               std::span<const NodeId> own) const;

 private:
  static constexpr int kBlockBits = 3;
  /// 8 × 8 × 8 cells, the last coordinate first: what lies side by side in the sheet does in memory. Per cell the first of its
  /// entries, −1: none.
  using Block = std::array<std::int32_t, 1 << (3 * kBlockBits)>;
  /// One of the triangles of a cell; the cell's are linked.
  struct Entry {
    TriId triangle;
    std::int32_t next;
  };
  static Cell block_of(const Cell& cell);
  static std::size_t place_in_block(const Cell& cell);

  double cell_;
  std::vector<int> part_;  // per triangle
  std::vector<Entry> entries_;
  std::unordered_map<Cell, Block, CellHash> blocks_;
};

}  // namespace conchoid
