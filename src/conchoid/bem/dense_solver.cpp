#include "conchoid/bem/dense_solver.hpp"

#include <cblas.h>

#include <algorithm>

#include "conchoid/bem/tiled_cholesky.hpp"
#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kVectors = 48;  // right-hand sides of one task

template <class Id>
std::span<const Id> part(const std::vector<Id>& all, std::size_t first, std::size_t count) {
  return std::span(all).subspan(first / 3, count / 3);
}

class DenseSolver : public BodySolver {
 public:
  DenseSolver(BodyEntries& entries, const RigidMotions& motions, const KeptSystem& kept)
      : nq_(entries.body().tractions()),
        nu_(entries.body().displacements()),
        V_(nq_),
        S_(nu_),
        W_(nq_ * nu_) {
    if (kept.cache && recall(kept)) return;
    const OneBlasThread one_blas_thread;
    entries.keep_pairs();
    factor_single_layer(entries);
    assemble_schur_complement(entries);
    hold(motions);
    if (!S_.factor())
      throw ComputationError(
          "the body's stiffness is not positive definite: the surface mesh has overlapping or nearly "
          "degenerate triangles; run `conchoid mesh` on it and remesh");
    if (kept.cache) keep(kept);
  }

  void apply(const double* x, double* y, std::size_t count) const override {
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
      multiply(CblasNoTrans, columns, -V_.scale(), own.data(), q);
      multiply(CblasTrans, columns, 1, q, u);
      V_.apply_lower(q, columns, size());
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < nq_; ++i)
          q[c * size() + i] /= V_.scale();
    });
  }

  void solve(double* b, std::size_t count) const override {
    in_parts(b, count, [&](double* q, double* u, std::size_t columns) {
      V_.solve_lower(q, columns, size());
      multiply(CblasTrans, columns, -V_.scale(), q, u);
      S_.solve_lower(u, columns, size());
      S_.solve_transposed(u, columns, size());
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < nu_; ++i)
          u[c * size() + i] *= S_.scale();
      multiply(CblasNoTrans, columns, 1, u, q);
      V_.solve_transposed(q, columns, size());
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < nq_; ++i)
          q[c * size() + i] *= V_.scale();
    });
  }

  std::size_t bytes() const override { return V_.bytes() + S_.bytes() + W_.size() * sizeof(double); }

 private:
  std::size_t size() const { return nq_ + nu_; }

  void keep(const KeptSystem& kept) const {
    ByteWriter out;
    V_.put(out);
    S_.put(out);
    out.put_all(std::span<const double>(W_));
    kept.cache->keep(kept.name, out.bytes());
  }

  bool recall(const KeptSystem& kept) {
    const std::optional<std::string> bytes = kept.cache->recall(kept.name);
    if (!bytes) return false;
    ByteReader in(*bytes);
    V_.get(in);
    S_.get(in);
    W_ = in.get_all<double>(W_.size());
    return true;
  }

  // Vectors in fixed portions: task(tractions, displacements, vectors).
  template <class Task>
  void in_parts(double* vectors, std::size_t count, const Task& task) const {
    if (size() == 0) return;
    const OneBlasThread one_blas_thread;
    parallel_for(count, kVectors, [&](std::size_t begin, std::size_t end) {
      double* first = vectors + begin * size();
      task(first, first + nq_, end - begin);
    });
  }

  // to += factor W from, or Wᵀ.
  void multiply(CBLAS_TRANSPOSE transpose, std::size_t count, double factor, const double* from,
                double* to) const {
    if (nq_ == 0 || nu_ == 0) return;
    const int q = static_cast<int>(nq_), u = static_cast<int>(nu_), n = static_cast<int>(size());
    cblas_dgemm(CblasColMajor, transpose, CblasNoTrans, transpose == CblasTrans ? u : q,
                static_cast<int>(count), transpose == CblasTrans ? q : u, factor, W_.data(), q, from, n, 1.0,
                to, n);
  }

  void factor_single_layer(const BodyEntries& entries) {
    const auto& held = entries.body().held_triangles;
    const std::vector<TiledCholesky::Tile> tiles = V_.tiles();
    parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const TiledCholesky::Tile& t = tiles[i];
        entries.system_single_layer(part(held, t.row, t.rows), part(held, t.column, t.columns),
                                    {t.data, 1, t.rows});
      }
    });
    if (!V_.factor())
      throw ComputationError(
          "the single layer matrix is not positive definite: the surface mesh has overlapping or nearly "
          "degenerate triangles; run `conchoid mesh` on it and remesh");
    parallel_for(held.size(), 4, [&](std::size_t begin, std::size_t end) {
      entries.system_double_layer(std::span(held).subspan(begin, end - begin), entries.body().free_nodes,
                                  {W_.data() + 3 * begin, 1, nq_});
    });
    parallel_for(nu_, kVectors, [&](std::size_t begin, std::size_t end) {
      V_.solve_lower(W_.data() + begin * nq_, end - begin, nq_);
    });
  }

  void assemble_schur_complement(const BodyEntries& entries) {
    const auto& nodes = entries.body().free_nodes;
    const std::vector<TiledCholesky::Tile> tiles = S_.tiles();
    const int q = static_cast<int>(nq_);
    parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const TiledCholesky::Tile& t = tiles[i];
        entries.system_hypersingular(part(nodes, t.row, t.rows), part(nodes, t.column, t.columns),
                                     {t.data, 1, t.rows});
        if (nq_ > 0)
          cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(t.rows),
                      static_cast<int>(t.columns), q, V_.scale(), W_.data() + t.row * nq_, q,
                      W_.data() + t.column * nq_, q, 1.0, t.data, static_cast<int>(t.rows));
      }
    });
  }

  void hold(const RigidMotions& motions) {
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

  std::size_t nq_, nu_;
  TiledCholesky V_, S_;
  std::vector<double> W_;  // column-major
};

}  // namespace

std::unique_ptr<BodySolver> make_dense_solver(BodyEntries& entries, const RigidMotions& motions,
                                              const KeptSystem& kept) {
  return std::make_unique<DenseSolver>(entries, motions, kept);
}

}  // namespace conchoid
