#pragma once

#include <optional>
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
                               const std::vector<NodeId>& own) const;

 private:
  double cell_;
  std::vector<int> part_;  // per triangle
  std::unordered_map<Cell, std::vector<TriId>, CellHash> triangles_;
};

}  // namespace conchoid
