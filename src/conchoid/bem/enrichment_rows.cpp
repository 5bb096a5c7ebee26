#include "conchoid/bem/enrichment_rows.hpp"

#include <algorithm>
#include <numeric>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

// A enrichment function as one panel sees it.
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

struct TestRows {
  const LocalFunction& f;
  EnrichmentRows rows;
};

class RowAssembler {
 public:
  enum class Part { all, load };

  RowAssembler(const EnrichmentProblem& problem, const EnrichedSpace& space,
               const std::vector<std::size_t>& wanted, Part part)
      : p_(problem),
        body_(problem.body.blocks()),
        space_(space),
        part_(part),
        trial_(space.panels.size()),
        test_(space.panels.size()) {
    for (const Panel& panel : space.panels)
      curls_.push_back(surface_curls(panel));
    for (std::size_t f = 0; f < space.functions.size(); ++f)
      register_function(f, f, trial_);
    for (std::size_t w = 0; w < wanted.size(); ++w)
      register_function(wanted[w], w, test_);
    for (std::size_t x = 0; x < test_.size(); ++x)
      if (!test_[x].empty()) test_panels_.push_back(x);
    test_index_.assign(test_.size(), -1);
    for (std::size_t i = 0; i < test_panels_.size(); ++i)
      test_index_[test_panels_[i]] = static_cast<long>(i);
    rows_.assign(wanted.size(), empty_rows());
    if (part_ == Part::load) return;
    const std::size_t n = test_panels_.size();
    table_.resize(n * (n + 1) / 2);
    parallel_for(n, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          table_[i * (i + 1) / 2 + j] = p_.body.integrator().single_layer(space_.panels[test_panels_[i]],
                                                                          space_.panels[test_panels_[j]]);
    });
  }

  // Panels in batches: each panel's contributions are computed apart and added in the order of the panels.
  std::vector<EnrichmentRows> assemble() {
    constexpr std::size_t batch = 64;
    for (std::size_t start = 0; start < test_panels_.size(); start += batch) {
      const std::size_t count = std::min(batch, test_panels_.size() - start);
      std::vector<std::vector<TestRows>> parts(count);
      parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          parts[i] = rows_of_panel(test_panels_[start + i]);
      });
      for (const auto& part : parts)
        for (const TestRows& t : part)
          accumulate(t.rows, rows_[t.f.index]);
    }
    return std::move(rows_);
  }

 private:
  void register_function(std::size_t function, std::size_t index, PanelFunctions& lists) const {
    for (const PanelValues& v : space_.functions[function].support)
      lists[v.panel].push_back({index, v.w, curl_of(curls_[v.panel], v.w)});
  }

  EnrichmentRows empty_rows() const {
    EnrichmentRows r;
    if (part_ == Part::load) return r;
    r.D_body = DenseMatrix(3, 3 * body_.unknowns.displacement_count);
    r.D_enriched = DenseMatrix(3, 3 * space_.functions.size());
    r.K = DenseMatrix(3 * body_.unknowns.traction_count, 3);
    return r;
  }

  static void accumulate(const EnrichmentRows& from, EnrichmentRows& to) {
    const auto add = [](const std::vector<double>& a, std::vector<double>& b) {
      for (std::size_t i = 0; i < a.size(); ++i)
        b[i] += a[i];
    };
    add(from.D_body.data, to.D_body.data);
    add(from.D_enriched.data, to.D_enriched.data);
    add(from.K.data, to.K.data);
    to.load += from.load;
  }

  std::vector<TestRows> rows_of_panel(std::size_t x) const {
    std::vector<TestRows> out;
    for (const LocalFunction& f : test_[x]) {
      out.push_back({f, empty_rows()});
      out.back().rows.load = own_load(x, f);
    }
    for (std::size_t y = 0; y < space_.panels.size(); ++y) {
      const bool on_surface = y < space_.surface_count;
      if (part_ == Part::load ? !on_surface || !carries_load(y) : !on_surface && trial_[y].empty()) continue;
      const PairBlocks blocks(pair(x, y), p_.body.material());
      if (part_ == Part::all)
        for (TestRows& t : out)
          for (const LocalFunction& g : trial_[y])
            t.rows.D_enriched.add(0, 3 * g.index, blocks.hypersingular(t.f.curl, g.curl));
      if (on_surface) add_body(x, y, blocks, out);
    }
    return out;
  }

  bool carries_load(std::size_t y) const {
    const auto& nodes = p_.body.surface().corners[space_.parent[y]];
    return p_.load.traction[space_.parent[y].index()] != Vec3::Zero() ||
           std::any_of(nodes.begin(), nodes.end(),
                       [&](NodeId i) { return p_.load.displacement[i] != Vec3::Zero(); });
  }

  SingleLayerPair pair(std::size_t x, std::size_t y) const {
    const std::size_t i = std::max(x, y), j = test_[y].empty() ? y : std::min(x, y);
    const std::size_t first = test_[y].empty() ? x : i;
    if (part_ == Part::load || test_[y].empty())
      return p_.body.integrator().single_layer(space_.panels[first], space_.panels[j]);
    const long row = test_index_[i], column = test_index_[j];
    return table_[row * (row + 1) / 2 + column];
  }

  // Interaction with the body's own functions on surface piece y.
  void add_body(std::size_t x, std::size_t y, const PairBlocks& blocks, std::vector<TestRows>& out) const {
    const TriId parent = space_.parent[y];
    const auto& nodes = p_.body.surface().corners[parent];
    for (int k = 0; k < 3; ++k) {
      const int column = body_.unknowns.displacement[nodes[k].index()];
      if (column < 0 ? p_.load.displacement[nodes[k]] == Vec3::Zero() : part_ == Part::load) continue;
      for (TestRows& t : out) {
        const Mat3 block = blocks.hypersingular(t.f.curl, body_.curls[parent.index()][k]);
        if (column >= 0)
          t.rows.D_body.add(0, 3 * static_cast<std::size_t>(column), block);
        else
          t.rows.load -= block * p_.load.displacement[nodes[k]];
      }
    }
    const int q = body_.unknowns.traction[parent.index()];
    if (q < 0 ? p_.load.traction[parent.index()] == Vec3::Zero() : part_ == Part::load) return;
    const DoubleLayerPair dl = p_.body.integrator().double_layer(space_.panels[y], space_.panels[x]);
    for (TestRows& t : out) {
      const Mat3 block = blocks.double_layer(t.f.curl, weigh(dl, t.f.w));
      if (q >= 0)
        t.rows.K.add(3 * static_cast<std::size_t>(q), 0, block);
      else
        t.rows.load -= block.transpose() * p_.load.traction[parent.index()];
    }
  }

  // ½M g_N on the surface; the ambient stress, as the traction it puts on the crack plane, on the crack.
  Vec3 own_load(std::size_t x, const LocalFunction& f) const {
    const Panel& panel = space_.panels[x];
    if (x < space_.surface_count) {
      const std::size_t t = space_.parent[x].index();
      const double mean = (f.w[0] + f.w[1] + f.w[2]) / 3;
      return 0.5 * mean * panel.area * p_.load.traction[t];
    }
    if (!p_.load.ambient.stress) return Vec3::Zero();
    Vec3 load = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {  // edge midpoints: exact for linear stress times linear shape
      const Vec3 middle = 0.5 * (panel.x[k] + panel.x[(k + 1) % 3]);
      const double opening = -0.5 * (f.w[k] + f.w[(k + 1) % 3]);
      load += panel.area / 3 * opening * (p_.load.ambient.stress(middle) * panel.normal);
    }
    return load;
  }

  const EnrichmentProblem& p_;
  const BodyBlocks& body_;
  const EnrichedSpace& space_;
  const Part part_;
  std::vector<std::array<Vec3, 3>> curls_;
  PanelFunctions trial_, test_;
  std::vector<std::size_t> test_panels_;
  std::vector<EnrichmentRows> rows_;
  std::vector<long> test_index_;
  std::vector<SingleLayerPair> table_;
};

}  // namespace

std::vector<EnrichmentRows> assemble_enrichment_rows(const EnrichmentProblem& problem,
                                                     const EnrichedSpace& space,
                                                     const std::vector<std::size_t>& wanted) {
  return RowAssembler(problem, space, wanted, RowAssembler::Part::all).assemble();
}

std::vector<Vec3> assemble_enrichment_loads(const EnrichmentProblem& problem, const EnrichedSpace& space) {
  std::vector<std::size_t> all(space.functions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Vec3> loads;
  for (const EnrichmentRows& rows : RowAssembler(problem, space, all, RowAssembler::Part::load).assemble())
    loads.push_back(rows.load);
  return loads;
}

}  // namespace conchoid
