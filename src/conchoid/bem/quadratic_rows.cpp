#include "conchoid/bem/quadratic_rows.hpp"

#include <algorithm>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

/// A wanted function as one panel of its support sees it.
struct LocalFunction {
  std::size_t index;  // in `wanted`
  std::array<double, 3> w;
  Vec3 curl;
};

/// Surface curl of a quadratic function of a panel at barycentric coordinates l. docs/theory.md (B10)
Vec3 curl_at(const std::array<Vec3, 3>& c, int function, const Vec3& l) {
  if (function < 3) return (4 * l[function] - 1) * c[static_cast<std::size_t>(function)];
  const int j = function - 3, k = (j + 1) % 3;
  return 4 * (l[j] * c[static_cast<std::size_t>(k)] + l[k] * c[static_cast<std::size_t>(j)]);
}

/// Density 1 on X, N_b on Y.
std::array<SingleLayerPair, 3> summed_over_x(const LinearSingleLayerPair& pair) {
  std::array<SingleLayerPair, 3> out;
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t a = 0; a < 3; ++a) {
      const SingleLayerPair& part = pair[3 * a + b];
      out[b].laplace += part.laplace;
      for (std::size_t i = 0; i < 6; ++i)
        out[b].tensor[i] += part.tensor[i];
    }
  return out;
}

class Assembler {
 public:
  Assembler(const QuadraticSpace& body, const EnrichedSpace& enriched, const std::vector<std::size_t>& wanted)
      : body_(body),
        enriched_(enriched),
        wanted_(wanted),
        tractions_(body.tractions()),
        unknowns_(body.tractions() + body.displacements()),
        test_(enriched.panels.size()) {
    for (std::size_t w = 0; w < wanted.size(); ++w)
      for (const PanelValues& v : enriched.functions[wanted[w]].support) {
        const std::array<Vec3, 3> c = surface_curls(enriched.panels[v.panel]);
        test_[v.panel].push_back({w, v.w, v.w[0] * c[0] + v.w[1] * c[1] + v.w[2] * c[2]});
      }
  }

  // In batches of panels; what each adds is computed apart and added in their order.
  std::vector<DenseMatrix> assemble() const {
    constexpr std::size_t batch = 32;
    std::vector<DenseMatrix> out(wanted_.size(), DenseMatrix(3, unknowns_));
    std::vector<std::size_t> panels;
    for (std::size_t x = 0; x < test_.size(); ++x)
      if (!test_[x].empty()) panels.push_back(x);
    std::vector<LocalRows> parts(batch);  // laid out once: they are large
    for (std::size_t start = 0; start < panels.size(); start += batch) {
      const std::size_t count = std::min(batch, panels.size() - start);
      parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          fill_rows(panels[start + i], parts[i]);
      });
      for (std::size_t part = 0; part < count; ++part)
        for (std::size_t f = 0; f < test_[panels[start + part]].size(); ++f) {
          std::vector<double>& to = out[test_[panels[start + part]][f].index].data;
          for (std::size_t i = 0; i < to.size(); ++i)
            to[i] += parts[part][f].data[i];
        }
    }
    for (std::size_t w = 0; w < wanted_.size(); ++w)
      keep_unknown(enriched_.functions[wanted_[w]].free, out[w]);
    return out;
  }

 private:
  /// Of the functions on one panel; there may be more.
  using LocalRows = std::vector<DenseMatrix>;

  void fill_rows(std::size_t x, LocalRows& out) const {
    if (out.size() < test_[x].size()) out.resize(test_[x].size(), DenseMatrix(3, unknowns_));
    for (std::size_t f = 0; f < test_[x].size(); ++f)
      std::fill(out[f].data.begin(), out[f].data.end(), 0.0);
    for (std::size_t y = 0; y < enriched_.surface_count; ++y) {
      const std::array<SingleLayerPair, 3> pairs =
          summed_over_x(body_.integrator.single_layer(enriched_.panels[x], enriched_.panels[y]));
      const std::array<PairBlocks, 3> blocks = {PairBlocks(pairs[0], body_.corners.m),
                                                PairBlocks(pairs[1], body_.corners.m),
                                                PairBlocks(pairs[2], body_.corners.m)};
      add_displacements(x, y, blocks, out);
      add_tractions(x, y, blocks, out);
    }
  }

  void add_displacements(std::size_t x, std::size_t y, const std::array<PairBlocks, 3>& blocks,
                         LocalRows& out) const {
    const std::size_t parent = enriched_.parent[y].index();
    for (int k = 0; k < 6; ++k) {
      const int unknown = body_.unknown[body_.nodes[parent][static_cast<std::size_t>(k)]];
      if (unknown < 0) continue;
      const std::size_t column = tractions_ + 3 * static_cast<std::size_t>(unknown);
      for (std::size_t b = 0; b < 3; ++b) {
        const Vec3 curl = curl_at(body_.corners.curls[parent], k, enriched_.parent_values[y][b]);
        for (std::size_t f = 0; f < test_[x].size(); ++f)
          out[f].add(0, column, blocks[b].hypersingular(test_[x][f].curl, curl));
      }
    }
  }

  void add_tractions(std::size_t x, std::size_t y, const std::array<PairBlocks, 3>& blocks,
                     LocalRows& out) const {
    const std::size_t parent = enriched_.parent[y].index();
    const int held = body_.corners.traction_unknown[parent];
    if (held < 0) return;
    const QuadraticDoubleLayerPair laplace =
        body_.integrator.double_layer(enriched_.panels[y], enriched_.panels[x]);
    for (std::size_t f = 0; f < test_[x].size(); ++f) {
      const std::array<double, 3>& w = test_[x][f].w;
      for (std::size_t b = 0; b < 3; ++b) {
        double dl = 0;  // of the linear function, by its values in the six nodes
        for (std::size_t k = 0; k < 3; ++k)
          dl += w[k] * laplace(static_cast<int>(b), static_cast<int>(k)) +
                0.5 * (w[k] + w[(k + 1) % 3]) * laplace(static_cast<int>(b), static_cast<int>(3 + k));
        const Mat3 block = blocks[b].double_layer(test_[x][f].curl, dl).transpose();
        for (int a = 0; a < 3; ++a)
          if (const double value = enriched_.parent_values[y][b][a]; value != 0)
            out[f].add(0, 9 * static_cast<std::size_t>(held) + 3 * static_cast<std::size_t>(a),
                       value * block);
      }
    }
  }

  // Without the components that are prescribed, of the function and of what it meets.
  void keep_unknown(const Mat3& free, DenseMatrix& rows) const {
    const auto project = [&](std::size_t column, const Mat3& onto) {
      if (free.isIdentity(0) && onto.isIdentity(0)) return;
      Mat3 block;
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          block(p, q) = rows(static_cast<std::size_t>(p), column + static_cast<std::size_t>(q));
      rows.add(0, column, free * block * onto - block);
    };
    for (std::size_t h = 0; h < body_.corners.held_triangles.size(); ++h)
      for (std::size_t a = 0; a < 3; ++a)
        project(9 * h + 3 * a, body_.corners.unknown_traction[h]);
    for (std::size_t i = 0; i < body_.free_nodes.size(); ++i)
      project(tractions_ + 3 * i, body_.unknown_part[i]);
  }

  const QuadraticSpace& body_;
  const EnrichedSpace& enriched_;
  const std::vector<std::size_t>& wanted_;
  std::size_t tractions_, unknowns_;
  std::vector<std::vector<LocalFunction>> test_;  // per panel
};

}  // namespace

std::vector<DenseMatrix> assemble_quadratic_rows(const QuadraticSpace& body, const EnrichedSpace& enriched,
                                                 const std::vector<std::size_t>& wanted) {
  return Assembler(body, enriched, wanted).assemble();
}

std::vector<QuadraticLoadedPanel> loaded_pieces(const QuadraticSpace& body, const EnrichedSpace& enriched,
                                                const std::vector<double>& x) {
  const auto displacement = [&](std::size_t node) {
    const int i = body.unknown[node];
    return i < 0 ? Vec3(Vec3::Zero())
                 : Vec3(Eigen::Map<const Vec3>(&x[body.tractions() + 3 * static_cast<std::size_t>(i)]));
  };
  std::vector<QuadraticLoadedPanel> out;
  for (std::size_t p = 0; p < enriched.panels.size(); ++p) {
    QuadraticLoadedPanel panel{enriched.panels[p], {}, {}};
    panel.traction.fill(Vec3::Zero());
    panel.density.fill(Vec3::Zero());
    if (p < enriched.surface_count) {
      const std::size_t parent = enriched.parent[p].index();
      const std::array<Vec3, 3>& corner = enriched.parent_values[p];
      for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 l = i < 3 ? corner[i] : Vec3(0.5 * (corner[i - 3] + corner[(i - 2) % 3]));
        const Eigen::Matrix<double, 6, 1> phi = quadratic_functions(l);
        for (std::size_t k = 0; k < 6; ++k)
          panel.density[i] += phi[static_cast<int>(k)] * displacement(body.nodes[parent][k]);
      }
      if (const int held = body.corners.traction_unknown[parent]; held >= 0)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t a = 0; a < 3; ++a)
            panel.traction[i] += corner[i][static_cast<int>(a)] *
                                 Eigen::Map<const Vec3>(&x[9 * static_cast<std::size_t>(held) + 3 * a]);
    }
    out.push_back(std::move(panel));
  }
  return out;
}

}  // namespace conchoid
