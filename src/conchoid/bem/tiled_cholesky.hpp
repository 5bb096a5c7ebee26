#pragma once

#include <cstddef>
#include <vector>

namespace conchoid {

class ByteWriter;
class ByteReader;

/// Lower Cholesky factor of a large symmetric positive definite matrix, on square tiles: s A = L Lᵀ, with a
/// power of two s that makes the digits of L independent of the units.
/// Factoring runs as tasks over tiles, each with one BLAS thread. Tile size and order of the updates of a tile
/// are fixed, so L has the same bits for every number of threads.
/// Memory: 4 n² bytes and half a row of tiles; the upper triangle is not stored.
class TiledCholesky {
 public:
  static constexpr std::size_t kTile = 192;  ///< a multiple of three: no block of a node or triangle is split

  struct Tile {
    std::size_t row, column, rows, columns;  ///< place of its first entry in A, and its size
    double* data;                            ///< column-major, `rows` apart
  };

  explicit TiledCholesky(std::size_t n = 0);

  std::size_t size() const { return n_; }
  std::size_t bytes() const;
  /// Tiles of the lower triangle, to be filled with A (of those on the diagonal the lower triangle counts).
  std::vector<Tile> tiles();
  /// One entry of A, row ≥ column.
  double& entry(std::size_t row, std::size_t column);

  /// Replaces A by L. False when A is not positive definite; the tiles are then spoilt.
  [[nodiscard]] bool factor();
  double scale() const { return scale_; }

  /// L and s as they are, and back; get() throws OutOfBytes, and InputError for those of another size.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);

  // In place on `count` vectors whose first entries lie `stride` apart; on the calling thread.
  void solve_lower(double* b, std::size_t count, std::size_t stride) const;       ///< L⁻¹ b
  void solve_transposed(double* b, std::size_t count, std::size_t stride) const;  ///< L⁻ᵀ b
  void apply_lower(double* b, std::size_t count, std::size_t stride) const;       ///< L b
  void apply_transposed(double* b, std::size_t count, std::size_t stride) const;  ///< Lᵀ b

 private:
  std::size_t tile_rows(std::size_t i) const;
  double* tile(std::size_t i, std::size_t j);
  const double* tile(std::size_t i, std::size_t j) const;

  std::size_t n_, tiles_;
  double scale_ = 1;
  std::vector<std::vector<double>> data_;  // tile (i, j), i ≥ j, at i (i+1)/2 + j
};

}  // namespace conchoid
