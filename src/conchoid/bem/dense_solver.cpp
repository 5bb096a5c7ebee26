#include "conchoid/bem/dense_solver.hpp"

#include <optional>

#include "conchoid/bem/schur_factors.hpp"
#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

template <class Id>
std::span<const Id> part(const std::vector<Id>& all, std::size_t first, std::size_t count) {
  return std::span(all).subspan(first / 3, count / 3);
}

class DenseSolver : public BodySolver {
 public:
  DenseSolver(BodyEntries& entries, const RigidMotions& motions, const KeptSystem& kept)
      : factors_(entries.body().tractions(), entries.body().displacements()) {
    if (kept.cache && recall(kept)) return;
    const OneBlasThread one_blas_thread;
    entries.keep_pairs();
    eliminate_tractions(entries);
    assemble_hypersingular(entries);
    factors_.factor(motions);
    if (kept.cache) keep(kept);
  }

  void apply(const double* x, double* y, std::size_t count) const override { factors_.apply(x, y, count); }
  void solve(double* b, std::size_t count) const override { factors_.solve(b, count); }
  std::size_t bytes() const override { return factors_.bytes(); }

 private:
  void keep(const KeptSystem& kept) const {
    ByteWriter out;
    factors_.put(out);
    kept.cache->keep(kept.name, out.bytes());
  }

  bool recall(const KeptSystem& kept) {
    const std::optional<std::string> bytes = kept.cache->recall(kept.name);
    if (!bytes) return false;
    ByteReader in(*bytes);
    factors_.get(in);
    return true;
  }

  void eliminate_tractions(const BodyEntries& entries) {
    const auto& held = entries.body().held_triangles;
    const std::vector<TiledCholesky::Tile> tiles = factors_.V().tiles();
    parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const TiledCholesky::Tile& t = tiles[i];
        entries.system_single_layer(part(held, t.row, t.rows), part(held, t.column, t.columns),
                                    {t.data, 1, t.rows});
      }
    });
    factors_.factor_single_layer();
    parallel_for(held.size(), 4, [&](std::size_t begin, std::size_t end) {
      entries.system_double_layer(std::span(held).subspan(begin, end - begin), entries.body().free_nodes,
                                  {factors_.W().data() + 3 * begin, 1, factors_.tractions()});
    });
    factors_.reduce_coupling();
  }

  void assemble_hypersingular(const BodyEntries& entries) {
    const auto& nodes = entries.body().free_nodes;
    const std::vector<TiledCholesky::Tile> tiles = factors_.S().tiles();
    parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const TiledCholesky::Tile& t = tiles[i];
        entries.system_hypersingular(part(nodes, t.row, t.rows), part(nodes, t.column, t.columns),
                                     {t.data, 1, t.rows});
      }
    });
  }

  SchurFactors factors_;
};

}  // namespace

std::unique_ptr<BodySolver> make_dense_solver(BodyEntries& entries, const RigidMotions& motions,
                                              const KeptSystem& kept) {
  return std::make_unique<DenseSolver>(entries, motions, kept);
}

}  // namespace conchoid
