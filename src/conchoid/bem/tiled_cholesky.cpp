#include "conchoid/bem/tiled_cholesky.hpp"

#include <cblas.h>

#include <algorithm>

#include "conchoid/bem/blas.hpp"
#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

int as_int(std::size_t n) {
  return static_cast<int>(n);
}

// c −= a bᵀ or c −= aᵀ b and the like for tiles and slices of vectors.
void multiply_add(CBLAS_TRANSPOSE transpose, std::size_t rows, std::size_t columns, std::size_t inner,
                  double factor, const double* a, std::size_t lead_a, const double* b, std::size_t lead_b,
                  double* c, std::size_t lead_c) {
  cblas_dgemm(CblasColMajor, transpose, CblasNoTrans, as_int(rows), as_int(columns), as_int(inner), factor, a,
              as_int(lead_a), b, as_int(lead_b), 1.0, c, as_int(lead_c));
}

}  // namespace

TiledCholesky::TiledCholesky(std::size_t n) : n_(n), tiles_((n + kTile - 1) / kTile) {
  data_.resize(tiles_ * (tiles_ + 1) / 2);
  for (std::size_t i = 0; i < tiles_; ++i) {
    throw_if_interrupted();
    for (std::size_t j = 0; j <= i; ++j)
      data_[i * (i + 1) / 2 + j].assign(tile_rows(i) * tile_rows(j), 0.0);
  }
}

std::size_t TiledCholesky::bytes() const {
  std::size_t entries = 0;
  for (const auto& tile : data_)
    entries += tile.size();
  return entries * sizeof(double);
}

void TiledCholesky::put(ByteWriter& out) const {
  out.put(static_cast<std::uint64_t>(n_));
  out.put(scale_);
  for (const auto& tile : data_)
    out.put_all(std::span<const double>(tile));
}

void TiledCholesky::get(ByteReader& in) {
  if (in.get<std::uint64_t>() != n_) throw InputError("has factors of another size");
  scale_ = in.get<double>();
  for (auto& tile : data_)
    in.get_into(std::span(tile));
}

std::size_t TiledCholesky::tile_rows(std::size_t i) const {
  return std::min(kTile, n_ - i * kTile);
}

double* TiledCholesky::tile(std::size_t i, std::size_t j) {
  return data_[i * (i + 1) / 2 + j].data();
}

const double* TiledCholesky::tile(std::size_t i, std::size_t j) const {
  return data_[i * (i + 1) / 2 + j].data();
}

std::vector<TiledCholesky::Tile> TiledCholesky::tiles() {
  std::vector<Tile> all;
  for (std::size_t i = 0; i < tiles_; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      all.push_back({i * kTile, j * kTile, tile_rows(i), tile_rows(j), tile(i, j)});
  return all;
}

double& TiledCholesky::entry(std::size_t row, std::size_t column) {
  const std::size_t i = row / kTile, j = column / kTile;
  return tile(i, j)[column % kTile * tile_rows(i) + row % kTile];
}

// Right-looking: column of tiles after column of tiles, each followed by the updates it causes.
bool TiledCholesky::factor() {
  if (n_ == 0) return true;
  const OneBlasThread one_blas_thread;
  scale_ = unit_scale(tile(0, 0)[0]);
  parallel_for(data_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (double& entry : data_[t])
        entry *= scale_;
  });
  for (std::size_t k = 0; k < tiles_; ++k) {
    const std::size_t width = tile_rows(k);
    if (!factor_in_place(tile(k, k), width, width)) return false;
    parallel_for(tiles_ - k - 1, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = k + 1 + begin; i < k + 1 + end; ++i)
        cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, as_int(tile_rows(i)),
                    as_int(width), 1.0, tile(k, k), as_int(width), tile(i, k), as_int(tile_rows(i)));
    });
    std::vector<std::pair<std::size_t, std::size_t>> updates;
    for (std::size_t i = k + 1; i < tiles_; ++i)
      for (std::size_t j = k + 1; j <= i; ++j)
        updates.emplace_back(i, j);
    parallel_for(updates.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t u = begin; u < end; ++u) {
        const auto [i, j] = updates[u];
        const int rows = as_int(tile_rows(i)), columns = as_int(tile_rows(j));
        if (i == j)
          cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rows, as_int(width), -1.0, tile(i, k), rows,
                      1.0, tile(i, i), rows);
        else
          cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows, columns, as_int(width), -1.0, tile(i, k),
                      rows, tile(j, k), columns, 1.0, tile(i, j), rows);
      }
    });
  }
  return true;
}

void TiledCholesky::solve_lower(double* b, std::size_t count, std::size_t stride) const {
  if (n_ == 0 || count == 0) return;
  const OneBlasThread one_blas_thread;
  for (std::size_t k = 0; k < tiles_; ++k) {
    throw_if_interrupted();
    const std::size_t width = tile_rows(k);
    double* own = b + k * kTile;
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, as_int(width),
                as_int(count), 1.0, tile(k, k), as_int(width), own, as_int(stride));
    for (std::size_t i = k + 1; i < tiles_; ++i)
      multiply_add(CblasNoTrans, tile_rows(i), count, width, -1.0, tile(i, k), tile_rows(i), own, stride,
                   b + i * kTile, stride);
  }
}

void TiledCholesky::solve_transposed(double* b, std::size_t count, std::size_t stride) const {
  if (n_ == 0 || count == 0) return;
  const OneBlasThread one_blas_thread;
  for (std::size_t k = tiles_; k-- > 0;) {
    throw_if_interrupted();
    const std::size_t width = tile_rows(k);
    double* own = b + k * kTile;
    for (std::size_t i = k + 1; i < tiles_; ++i)
      multiply_add(CblasTrans, width, count, tile_rows(i), -1.0, tile(i, k), tile_rows(i), b + i * kTile,
                   stride, own, stride);
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, as_int(width), as_int(count),
                1.0, tile(k, k), as_int(width), own, as_int(stride));
  }
}

void TiledCholesky::apply_lower(double* b, std::size_t count, std::size_t stride) const {
  if (n_ == 0 || count == 0) return;
  const OneBlasThread one_blas_thread;
  for (std::size_t k = tiles_; k-- > 0;) {
    throw_if_interrupted();
    const std::size_t width = tile_rows(k);
    double* own = b + k * kTile;
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, as_int(width),
                as_int(count), 1.0, tile(k, k), as_int(width), own, as_int(stride));
    for (std::size_t j = 0; j < k; ++j)
      multiply_add(CblasNoTrans, width, count, tile_rows(j), 1.0, tile(k, j), width, b + j * kTile, stride,
                   own, stride);
  }
}

void TiledCholesky::apply_transposed(double* b, std::size_t count, std::size_t stride) const {
  if (n_ == 0 || count == 0) return;
  const OneBlasThread one_blas_thread;
  for (std::size_t k = 0; k < tiles_; ++k) {
    throw_if_interrupted();
    const std::size_t width = tile_rows(k);
    double* own = b + k * kTile;
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, as_int(width), as_int(count),
                1.0, tile(k, k), as_int(width), own, as_int(stride));
    for (std::size_t i = k + 1; i < tiles_; ++i)
      multiply_add(CblasTrans, width, count, tile_rows(i), 1.0, tile(i, k), tile_rows(i), b + i * kTile,
                   stride, own, stride);
  }
}

}  // namespace conchoid
