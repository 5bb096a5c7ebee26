#include "conchoid/bem/dense_solver.hpp"

#include <algorithm>
#include <optional>

#include "conchoid/bem/node_groups.hpp"
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
  void reduce(double* b, std::size_t count) const override { factors_.reduce(b, count); }
  void middle(double* b, std::size_t count) const override { factors_.middle(b, count); }
  void expand(double* b, std::size_t count) const override { factors_.expand(b, count); }
  std::size_t bytes() const override { return factors_.bytes(); }

 private:
  void keep(const KeptSystem& kept) const {
    ByteWriter out;
    factors_.put(out);
    kept.cache->keep(kept.name, out.bytes());
  }

  bool recall(const KeptSystem& kept) {
    const std::optional<KeptBytes> known = kept.cache->recall(kept.name);
    if (!known) return false;
    ByteReader in(known->bytes);
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

  // Between groups of nodes that lie together, whatever their place in the system: a triangle's pairs are looked at once
  // for all nodes of a group.
  void assemble_hypersingular(const BodyEntries& entries) {
    constexpr std::size_t most = 160;
    const BodyDiscretisation& body = entries.body();
    const auto groups = compact_groups(body.surface.positions, body.free_nodes, most);
    parallel_for(groups.size() * groups.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        if (const std::size_t i = k / groups.size(), j = k % groups.size(); j <= i)
          assemble_hypersingular(entries, groups[i], groups[j]);
    });
  }

  void assemble_hypersingular(const BodyEntries& entries, std::span<const NodeId> rows,
                              std::span<const NodeId> columns) {
    const std::vector<int>& unknown = entries.body().displacement_unknown;
    std::vector<double> D(9 * rows.size() * columns.size());
    entries.system_hypersingular(rows, columns, {D.data(), 1, 3 * rows.size()});
    for (std::size_t b = 0; b < 3 * columns.size(); ++b)
      for (std::size_t a = 0; a < 3 * rows.size(); ++a) {
        const std::size_t row = 3 * static_cast<std::size_t>(unknown[rows[a / 3].index()]) + a % 3,
                          column = 3 * static_cast<std::size_t>(unknown[columns[b / 3].index()]) + b % 3;
        if (row < column && rows.data() == columns.data())
          continue;  // the block has it the other way round, too
        factors_.S().entry(std::max(row, column), std::min(row, column)) = D[3 * rows.size() * b + a];
      }
  }

  SchurFactors factors_;
};

}  // namespace

std::unique_ptr<BodySolver> make_dense_solver(BodyEntries& entries, const RigidMotions& motions,
                                              const KeptSystem& kept) {
  return std::make_unique<DenseSolver>(entries, motions, kept);
}

}  // namespace conchoid
