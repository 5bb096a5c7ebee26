#include "conchoid/bem/schur_factors.hpp"

#include <cblas.h>

#include <algorithm>

#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

// Right-hand sides of one task at most: each task goes through all of the factors.
constexpr std::size_t kVectors = 128;

// An even number of equal parts.
std::size_t vectors_of_part(std::size_t count) {
  const std::size_t parts = 2 * std::max<std::size_t>(1, (count + 2 * kVectors - 1) / (2 * kVectors));
  return std::max<std::size_t>(1, (count + parts - 1) / parts);
}

}  // namespace

// Vectors in portions that depend on their number alone: task(tractions, displacements, vectors).
template <class Task>
void SchurFactors::in_parts(double* vectors, std::size_t count, const Task& task) const {
  if (size() == 0) return;
  const OneBlasThread one_blas_thread;
  parallel_for(count, vectors_of_part(count), [&](std::size_t begin, std::size_t end) {
    double* first = vectors + begin * size();
    task(first, first + nq_, end - begin);
  });
}

// to += factor W from, or Wᵀ.
void SchurFactors::multiply(bool transposed, std::size_t count, double factor, const double* from,
                            double* to) const {
  if (nq_ == 0 || nu_ == 0) return;
  const int q = static_cast<int>(nq_), u = static_cast<int>(nu_), n = static_cast<int>(size());
  cblas_dgemm(CblasColMajor, transposed ? CblasTrans : CblasNoTrans, CblasNoTrans, transposed ? u : q,
              static_cast<int>(count), transposed ? q : u, factor, W_.data(), q, from, n, 1.0, to, n);
}

void SchurFactors::apply(const double* x, double* y, std::size_t count) const {
  std::copy_n(x, count * size(), y);
  in_parts(y, count, [&](double* q, double* u, std::size_t columns) {
    const std::vector<double> own(u, u + (columns > 0 ? (columns - 1) * size() + nu_ : 0));
    S_.apply_transposed(u, columns, size());
    S_.apply_lower(u, columns, size());
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t i = 0; i < nu_; ++i)
        u[c * size() + i] /= S_.scale();
    if (nq_ == 0) return;
    V_.apply_transposed(q, columns, size());  // Lᵀ q − s W u
    multiply(false, columns, -V_.scale(), own.data(), q);
    multiply(true, columns, 1, q, u);
    V_.apply_lower(q, columns, size());
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t i = 0; i < nq_; ++i)
        q[c * size() + i] /= V_.scale();
  });
}

void SchurFactors::reduce(double* b, std::size_t count) const {
  in_parts(b, count, [&](double* q, double* u, std::size_t columns) {
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t i = 0; i < nq_; ++i)
        q[c * size() + i] = -q[c * size() + i];
    V_.solve_lower(q, columns, size());
    multiply(true, columns, V_.scale(), q, u);
    S_.solve_lower(u, columns, size());
  });
}

void SchurFactors::middle(double* b, std::size_t count) const {
  for (std::size_t c = 0; c < count; ++c, b += size()) {
    for (std::size_t i = 0; i < nq_; ++i)
      b[i] *= -V_.scale();
    for (std::size_t i = nq_; i < size(); ++i)
      b[i] *= S_.scale();
  }
}

void SchurFactors::expand(double* b, std::size_t count) const {
  in_parts(b, count, [&](double* q, double* u, std::size_t columns) {
    S_.solve_transposed(u, columns, size());
    multiply(false, columns, V_.scale(), u, q);
    V_.solve_transposed(q, columns, size());
  });
}

void SchurFactors::put(ByteWriter& out) const {
  V_.put(out);
  S_.put(out);
  out.put_all(std::span<const double>(W_));
}

void SchurFactors::get(ByteReader& in) {
  V_.get(in);
  S_.get(in);
  W_ = in.get_all<double>(W_.size());
}

void SchurFactors::factor_single_layer() {
  if (!V_.factor())
    throw ComputationError(
        "the single layer matrix is not positive definite: the surface mesh has overlapping or nearly "
        "degenerate triangles; run `conchoid mesh` on it and remesh");
}

void SchurFactors::reduce_coupling() {
  if (nq_ == 0) return;
  const OneBlasThread one_blas_thread;
  parallel_for(nu_, vectors_of_part(nu_), [&](std::size_t begin, std::size_t end) {
    V_.solve_lower(W_.data() + begin * nq_, end - begin, nq_);
  });
}

void SchurFactors::factor(const RigidMotions& motions) {
  const OneBlasThread one_blas_thread;
  if (nq_ > 0) {
    const std::vector<TiledCholesky::Tile> tiles = S_.tiles();
    const int q = static_cast<int>(nq_);
    parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const TiledCholesky::Tile& t = tiles[i];
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(t.rows),
                    static_cast<int>(t.columns), q, V_.scale(), W_.data() + t.row * nq_, q,
                    W_.data() + t.column * nq_, q, 1.0, t.data, static_cast<int>(t.rows));
      }
    });
  }
  hold(motions);
  if (!S_.factor())
    throw ComputationError(
        "the body's stiffness is not positive definite: the surface mesh has overlapping or nearly "
        "degenerate triangles; run `conchoid mesh` on it and remesh");
}

void SchurFactors::hold(const RigidMotions& motions) {
  const std::vector<TiledCholesky::Tile> tiles = S_.tiles();
  double trace = 0;
  for (const TiledCholesky::Tile& t : tiles)
    if (t.row == t.column)
      for (std::size_t i = 0; i < t.rows; ++i)
        trace += t.data[i * t.rows + i];
  const double alpha = trace / static_cast<double>(std::max<std::size_t>(nu_, 1));
  for (const TiledCholesky::Tile& t : tiles)
    for (const std::vector<double>& r : motions)
      for (std::size_t j = 0; j < t.columns; ++j)
        for (std::size_t i = 0; i < t.rows; ++i)
          t.data[j * t.rows + i] += alpha * r[t.row + i] * r[t.column + j];
}

}  // namespace conchoid
