#include "conchoid/bem/enrichment_rows.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

// An enrichment function as one panel sees it.
struct LocalFunction {
  std::size_t index;  // in space.functions, or in `wanted` on the test side
  std::array<double, 3> w;
  Vec3 curl;
};
using PanelFunctions = std::vector<std::vector<LocalFunction>>;

Vec3 curl_of(const std::array<Vec3, 3>& corner_curls, const std::array<double, 3>& w) {
  return w[0] * corner_curls[0] + w[1] * corner_curls[1] + w[2] * corner_curls[2];
}

double weigh(const DoubleLayerPair& dl, const std::array<double, 3>& w) {
  return w[0] * dl[0] + w[1] * dl[1] + w[2] * dl[2];
}

// A triangle of the body with prescribed or unknown traction, as one panel sees it.
struct TractionPair {
  TriId parent;
  PairBlocks blocks;
  DoubleLayerPair double_layer;
};

// All trial functions as one panel sees them, whatever it is tested with, and what they are summed up from: integrals with
// all panels, and with those of the surface.
struct PanelSums {
  std::vector<SingleLayerPair> single_layer;
  std::vector<DoubleLayerPair> double_layer;
  std::vector<PairBlocks::TrialSum> enriched;  // per function of the space
  std::vector<PairBlocks::TrialSum> body;      // per node of the body
  std::vector<TractionPair> tractions;
};

class RowAssembler {
 public:
  enum class Part { all, sources };

  RowAssembler(const BodyOperator& body, const EnrichedSpace& space, std::span<const LoadSource> sources,
               const std::vector<std::size_t>& wanted, Part part, PairMemory* memory = nullptr)
      : body_(body.discretisation()),
        space_(space),
        wanted_(wanted),
        source_count_(sources.size()),
        part_(part),
        memory_(memory),
        integrator_(crack_tolerance(body.settings().quadrature_tolerance)),
        source_of_triangle_(body_.surface.triangle_count(), -1),
        source_of_node_(body_.surface.node_count(), -1),
        trial_(space.panels.size()),
        test_(space.panels.size()) {
    for (std::size_t s = 0; s < sources.size(); ++s)
      (sources[s].kind == Prescribed::traction ? source_of_triangle_ : source_of_node_)[sources[s].index] =
          static_cast<int>(s);
    for (const Panel& panel : space.panels)
      curls_.push_back(surface_curls(panel));
    for (std::size_t f = 0; f < space.functions.size(); ++f)
      register_function(f, f, trial_);
    rank_.assign(space.functions.size(), 0);
    for (std::size_t w = 0; w < wanted.size(); ++w) {
      register_function(wanted[w], w, test_);
      rank_[wanted[w]] = w;
    }
    for (std::size_t x = 0; x < test_.size(); ++x)
      if (!test_[x].empty()) test_panels_.push_back(x);
    test_index_.assign(test_.size(), -1);
    for (std::size_t i = 0; i < test_panels_.size(); ++i)
      test_index_[test_panels_[i]] = static_cast<long>(i);
    rows_.assign(wanted.size(), empty_rows());
    if (part_ == Part::sources) return;
    if (memory_) {
      memory_->match(space.panels);
      made_.resize(space.panels.size());
    }
    const std::size_t n = test_panels_.size();
    table_.resize(n * (n + 1) / 2);
    parallel_for(n, kTogether, [&](std::size_t begin, std::size_t end) {
      Wanted<SingleLayerPair> wanted;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          single_layer(test_panels_[i], test_panels_[j], table_[i * (i + 1) / 2 + j], wanted);
      integrate(wanted);
    });
  }

  // Panels in batches: what each sees is computed apart, then every function adds up its own panels in their order.
  std::vector<EnrichmentRows> assemble() {
    constexpr std::size_t batch = 64;
    std::vector<PanelSums> sums(batch);
    for (std::size_t start = 0; start < test_panels_.size(); start += batch) {
      const std::size_t count = std::min(batch, test_panels_.size() - start);
      parallel_for(count, kTogether, [&](std::size_t begin, std::size_t end) {
        integrate(std::span(test_panels_).subspan(start + begin, end - begin), &sums[begin]);
        for (std::size_t i = begin; i < end; ++i)
          sum_up(sums[i]);
      });
      std::vector<std::vector<TestedPanel>> tested(wanted_.size());
      for (std::size_t i = 0; i < count; ++i)
        for (const LocalFunction& f : test_[test_panels_[start + i]])
          tested[f.index].push_back({&sums[i], &f});
      parallel_for(wanted_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t w = begin; w < end; ++w)
          for (const TestedPanel& panel : tested[w])
            add_panel(*panel.sums, *panel.function, rows_[w]);
      });
    }
    if (memory_) memory_->remember(space_.panels, std::move(made_));
    for (std::size_t w = 0; w < rows_.size(); ++w)
      keep_unknown(space_.functions[wanted_[w]].free, rows_[w]);
    return std::move(rows_);
  }

 private:
  static constexpr std::size_t kTogether = 4;  // panels whose integrals are made side by side

  struct TestedPanel {
    const PanelSums* sums;
    const LocalFunction* function;
  };

  void register_function(std::size_t function, std::size_t index, PanelFunctions& lists) const {
    for (const PanelValues& v : space_.functions[function].support)
      lists[v.panel].push_back({index, v.w, curl_of(curls_[v.panel], v.w)});
  }

  // Without the components that are prescribed, of the function and of what it meets.
  void keep_unknown(const Mat3& free, EnrichmentRows& rows) const {
    if (!free.isIdentity(0))
      for (DenseMatrix* m : {&rows.body, &rows.enriched, &rows.sources})
        for (std::size_t j = 0; j < m->columns; ++j) {
          const Vec3 column((*m)(0, j), (*m)(1, j), (*m)(2, j));
          for (int p = 0; p < 3; ++p)
            (*m)(static_cast<std::size_t>(p), j) = free.row(p).dot(column);
        }
    if (part_ == Part::sources) return;
    for (std::size_t p = 0; p < 3; ++p) {
      body_.keep_unknown(rows.body.data.data() + p * rows.body.columns);
      double* enriched = rows.enriched.data.data() + p * rows.enriched.columns;
      for (std::size_t f = 0; f < space_.functions.size(); ++f)
        if (const Mat3& other = space_.functions[f].free; !other.isIdentity(0)) {
          Eigen::Map<Vec3> value(enriched + 3 * f);
          value = (other * value).eval();
        }
    }
  }

  EnrichmentRows empty_rows() const {
    EnrichmentRows r;
    r.sources = DenseMatrix(3, 3 * source_count_);
    if (part_ == Part::sources) return r;
    r.body = DenseMatrix(3, body_.unknowns());
    r.enriched = DenseMatrix(3, 3 * space_.functions.size());
    return r;
  }

  // Functions of the panel are still to come: it has a corner on the front, or lies at the mouth. Other pieces of the
  // surface are tested once, with the hat of the edge whose division made them.
  bool at_front(std::size_t x) const {
    return x < space_.surface_count ? std::any_of(trial_[x].begin(), trial_[x].end(),
                                                  [&](const LocalFunction& f) {
                                                    return space_.functions[f.index].carries_opening();
                                                  })
                                    : trial_[x].size() < 3;
  }

  void sum_up(PanelSums& out) const {
    out.enriched.assign(part_ == Part::all ? space_.functions.size() : 0, {});
    out.body.assign(body_.surface.node_count(), {});
    out.tractions.clear();
    Pieces pieces;
    for (std::size_t y = 0; y < space_.panels.size(); ++y) {
      if (!is_wanted(y)) continue;
      const SingleLayerPair& integrals = out.single_layer[y];
      if (part_ == Part::all && !trial_[y].empty()) {
        const PairBlocks blocks(integrals, body_.m);
        for (const LocalFunction& g : trial_[y])
          out.enriched[g.index].add(blocks, g.curl);
      }
      if (y >= space_.surface_count) continue;
      if (space_.parent[y] != pieces.parent) {
        add_body(pieces, out);
        pieces = {space_.parent[y], {}, {}};
      }
      pieces.add(integrals);
      if (needs_double_layer(y)) pieces.add(out.double_layer[y]);
    }
    add_body(pieces, out);
  }

  bool is_wanted(std::size_t y) const {
    const bool on_surface = y < space_.surface_count;
    return part_ == Part::sources ? on_surface && has_source(space_.parent[y])
                                  : on_surface || !trial_[y].empty();
  }
  bool needs_double_layer(std::size_t y) const {
    return y < space_.surface_count && !traction_columns(space_.parent[y]).none();
  }

  // Integrals of some panels with all that are wanted; those that are not known side by side.
  void integrate(std::span<const std::size_t> panels, PanelSums* out) {
    Wanted<SingleLayerPair> singles;
    Wanted<DoubleLayerPair> doubles;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t x = panels[i];
      out[i].single_layer.resize(space_.panels.size());
      out[i].double_layer.resize(space_.surface_count);
      for (std::size_t y = 0; y < space_.panels.size(); ++y) {
        if (!is_wanted(y)) continue;
        if (const SingleLayerPair* known = table_entry(x, y))
          out[i].single_layer[y] = *known;
        else
          single_layer(x, y, out[i].single_layer[y], singles);
        if (needs_double_layer(y)) double_layer(x, y, out[i].double_layer[y], doubles);
      }
    }
    integrate(singles);
    integrate(doubles);
    for (std::size_t i = 0; memory_ && i < panels.size(); ++i)
      if (at_front(panels[i])) made_[panels[i]] = remembered(out[i]);
  }

  PairMemory::Row remembered(const PanelSums& sums) const {
    PairMemory::Row row = PairMemory::row_of(space_.panels.size());
    for (std::size_t y = 0; y < space_.panels.size(); ++y) {
      if (!is_wanted(y)) continue;
      row.single_layer[y] = sums.single_layer[y];
      row.has_single[y] = 1;
      if (!needs_double_layer(y)) continue;
      row.double_layer[y] = sums.double_layer[y];
      row.has_double[y] = 1;
    }
    return row;
  }

  // Integrals of a panel with the pieces of one triangle of the body, on which its functions are the same.
  struct Pieces {
    TriId parent;
    SingleLayerPair single_layer{};
    DoubleLayerPair double_layer{};

    void add(const SingleLayerPair& s) {
      single_layer.laplace += s.laplace;
      for (std::size_t k = 0; k < s.tensor.size(); ++k)
        single_layer.tensor[k] += s.tensor[k];
    }
    void add(const DoubleLayerPair& d) {
      for (std::size_t k = 0; k < d.size(); ++k)
        double_layer[k] += d[k];
    }
  };

  bool has_source(TriId parent) const {
    const auto& nodes = body_.surface.corners[parent];
    return source_of_triangle_[parent.index()] >= 0 ||
           std::any_of(nodes.begin(), nodes.end(), [&](NodeId i) { return source_of_node_[i.index()] >= 0; });
  }

  // What is to be integrated, and where it goes.
  template <class Integrals>
  struct Wanted {
    std::vector<PanelPair> pairs;
    std::vector<Integrals*> to;
    void add(const Panel& x, const Panel& y, Integrals& place) {
      pairs.push_back({&x, &y});
      to.push_back(&place);
    }
  };

  void compute(std::span<const PanelPair> pairs, SingleLayerPair* out) const {
    integrator_.single_layer(pairs, out);
  }
  void compute(std::span<const PanelPair> pairs, DoubleLayerPair* out) const {
    integrator_.double_layer(pairs, out);
  }

  template <class Integrals>
  void integrate(const Wanted<Integrals>& wanted) const {
    std::vector<Integrals> made(wanted.pairs.size());
    compute(wanted.pairs, made.data());
    for (std::size_t i = 0; i < made.size(); ++i)
      *wanted.to[i] = made[i];
  }

  void single_layer(std::size_t x, std::size_t y, SingleLayerPair& to,
                    Wanted<SingleLayerPair>& wanted) const {
    const SingleLayerPair* known = memory_ ? memory_->single_layer(x, y) : nullptr;
    if (memory_ && !known) known = memory_->single_layer(y, x);
    if (known)
      to = *known;
    else
      wanted.add(space_.panels[x], space_.panels[y], to);
  }

  // Tested on x, with the functions of surface piece y.
  void double_layer(std::size_t x, std::size_t y, DoubleLayerPair& to,
                    Wanted<DoubleLayerPair>& wanted) const {
    if (const DoubleLayerPair* known = memory_ ? memory_->double_layer(x, y) : nullptr)
      to = *known;
    else
      wanted.add(space_.panels[y], space_.panels[x], to);
  }

  // A pair of panels that are both tested on: integrated once, before all rows.
  const SingleLayerPair* table_entry(std::size_t x, std::size_t y) const {
    if (table_.empty() || test_[y].empty()) return nullptr;
    const auto [j, i] = std::minmax(test_index_[x], test_index_[y]);
    return &table_[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
  }

  // Where a column of the body's functions goes: to an unknown, a source, both (where some components are
  // prescribed) or neither.
  struct Columns {
    std::optional<std::size_t> body, source;
    bool none() const { return !body && !source; }
    void add(EnrichmentRows& rows, const Mat3& block) const {
      if (body) rows.body.add(0, *body, block);
      if (source) rows.sources.add(0, *source, block);
    }
  };

  Columns columns(int unknown, std::size_t first, int source) const {
    Columns out;
    if (unknown >= 0 && part_ == Part::all) out.body = first + 3 * static_cast<std::size_t>(unknown);
    if (source >= 0) out.source = 3 * static_cast<std::size_t>(source);
    return out;
  }

  Columns traction_columns(TriId t) const {
    return columns(body_.traction_unknown[t.index()], 0, source_of_triangle_[t.index()]);
  }

  Columns displacement_columns(NodeId node) const {
    return columns(body_.displacement_unknown[node.index()], body_.tractions(),
                   source_of_node_[node.index()]);
  }

  // The body's own functions on one of its triangles.
  void add_body(const Pieces& pieces, PanelSums& out) const {
    if (!pieces.parent.valid()) return;
    const PairBlocks blocks(pieces.single_layer, body_.m);
    const auto& nodes = body_.surface.corners[pieces.parent];
    for (std::size_t k = 0; k < 3; ++k)
      if (!displacement_columns(nodes[k]).none())
        out.body[nodes[k].index()].add(blocks, body_.curls[pieces.parent.index()][k]);
    if (!traction_columns(pieces.parent).none())
      out.tractions.push_back({pieces.parent, blocks, pieces.double_layer});
  }

  // What a function has on one panel of its support.
  void add_panel(const PanelSums& sums, const LocalFunction& f, EnrichmentRows& rows) const {
    for (std::size_t g = 0; g < sums.enriched.size(); ++g)
      if (rank_[g] <= f.index) rows.enriched.add(0, 3 * g, sums.enriched[g].tested(f.curl));
    for (std::size_t node = 0; node < sums.body.size(); ++node)
      if (const Columns to = displacement_columns(NodeId(node)); !to.none())
        to.add(rows, sums.body[node].tested(f.curl));
    for (const TractionPair& t : sums.tractions)
      traction_columns(t.parent).add(rows,
                                     t.blocks.double_layer(f.curl, weigh(t.double_layer, f.w)).transpose());
  }

  const BodyDiscretisation& body_;
  const EnrichedSpace& space_;
  const std::vector<std::size_t>& wanted_;
  const std::size_t source_count_;
  const Part part_;
  PairMemory* memory_;
  const PairIntegrator integrator_;
  std::vector<PairMemory::Row> made_;                     // per panel; empty without a memory
  std::vector<int> source_of_triangle_, source_of_node_;  // −1: none
  std::vector<std::array<Vec3, 3>> curls_;
  PanelFunctions trial_, test_;
  std::vector<std::size_t> rank_;  // per function: its place in `wanted`, 0 if it is not
  std::vector<std::size_t> test_panels_;
  std::vector<EnrichmentRows> rows_;
  std::vector<long> test_index_;
  std::vector<SingleLayerPair> table_;
};

}  // namespace

std::vector<EnrichmentRows> assemble_enrichment_rows(const BodyOperator& body, const EnrichedSpace& space,
                                                     std::span<const LoadSource> sources,
                                                     const std::vector<std::size_t>& wanted,
                                                     PairMemory* memory) {
  return RowAssembler(body, space, sources, wanted, RowAssembler::Part::all, memory).assemble();
}

std::vector<DenseMatrix> assemble_source_columns(const BodyOperator& body, const EnrichedSpace& space,
                                                 std::span<const LoadSource> sources) {
  std::vector<std::size_t> all(space.functions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<DenseMatrix> columns;
  for (EnrichmentRows& rows : RowAssembler(body, space, sources, all, RowAssembler::Part::sources).assemble())
    columns.push_back(std::move(rows.sources));
  return columns;
}

Vec3 enrichment_load(const EnrichedSpace& space, const EnrichmentFunction& function, const LoadCase& load) {
  Vec3 f = Vec3::Zero();
  for (const PanelValues& v : function.support) {
    const Panel& panel = space.panels[v.panel];
    if (v.panel < space.surface_count) {
      const double mean = (v.w[0] + v.w[1] + v.w[2]) / 3;
      f += 0.5 * mean * panel.area * load.traction[space.parent[v.panel].index()];
    } else if (load.ambient.stress) {
      for (int k = 0; k < 3; ++k) {  // edge midpoints: exact for linear stress times linear shape
        const Vec3 middle = 0.5 * (panel.x[k] + panel.x[(k + 1) % 3]);
        const double opening = -0.5 * (v.w[k] + v.w[(k + 1) % 3]);
        f += panel.area / 3 * opening * (load.ambient.stress(middle) * panel.normal);
      }
    }
  }
  return f;
}

}  // namespace conchoid
