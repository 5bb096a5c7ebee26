#include "conchoid/bem/body_blocks.hpp"

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

// The geometric integrals of every pair, computed once and read by all rows that need them.
class PairTable {
 public:
  PairTable(const std::vector<Panel>& panels, const std::vector<char>& needs_double_layer,
            const PairIntegrator& integrator)
      : n_(panels.size()), single_(n_ * (n_ + 1) / 2), row_(n_, -1) {
    std::size_t rows = 0;
    for (std::size_t x = 0; x < n_; ++x)
      if (needs_double_layer[x]) row_[x] = static_cast<long>(rows++);
    double_.resize(rows * n_);
    parallel_for(n_, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t x = begin; x < end; ++x) {
        for (std::size_t y = 0; y <= x; ++y)
          single_[x * (x + 1) / 2 + y] = integrator.single_layer(panels[x], panels[y]);
        if (row_[x] < 0) continue;
        for (std::size_t y = 0; y < n_; ++y)
          double_[row_[x] * n_ + y] = integrator.double_layer(panels[x], panels[y]);
      }
    });
  }

  const SingleLayerPair& single_layer(std::size_t x, std::size_t y) const {
    return x >= y ? single_[x * (x + 1) / 2 + y] : single_[y * (y + 1) / 2 + x];
  }
  const DoubleLayerPair& double_layer(std::size_t x, std::size_t y) const {
    return double_[row_[x] * n_ + y];
  }

 private:
  std::size_t n_;
  std::vector<SingleLayerPair> single_;
  std::vector<long> row_;
  std::vector<DoubleLayerPair> double_;
};

// Everything a row needs to see, by one name each.
struct Problem {
  const TriMesh& surface;
  const BoundaryData& data;
  const ElasticConstants& m;
  const PairTable& pairs;
  std::vector<char> loaded;      // per triangle: prescribed traction that is not zero
  std::vector<char> prescribed;  // per node: on the displacement boundary
};

void add_to(std::vector<double>& f, std::size_t i, const Vec3& v) {
  for (int p = 0; p < 3; ++p)
    f[i + p] += v[p];
}

// Row block of node i: D against all nodes, and f_N = (½M − Kᵀ) g_N − D g_D.
void assemble_node_row(const Problem& p, NodeId node, const std::vector<std::pair<std::size_t, int>>& around,
                       BodyBlocks& out) {
  const std::size_t row = 3 * static_cast<std::size_t>(out.unknowns.displacement[node.index()]);
  Vec3 f = Vec3::Zero();
  for (const auto& [x, corner] : around) {
    const Vec3& b = out.curls[x][corner];
    if (p.loaded[x]) f += 0.5 * out.panels[x].area / 3 * p.data.traction[x];
    for (std::size_t y = 0; y < out.panels.size(); ++y) {
      const auto& nodes = p.surface.corners[TriId(y)];
      std::array<int, 3> column;
      bool needed = p.loaded[y];
      for (int k = 0; k < 3; ++k) {
        column[k] = out.unknowns.displacement[nodes[k].index()];
        needed = needed || (column[k] >= 0 ? 3 * static_cast<std::size_t>(column[k]) <= row
                                           : p.prescribed[nodes[k].index()] != 0);
      }
      if (!needed) continue;
      const PairBlocks blocks(p.pairs.single_layer(x, y), p.m);
      for (int k = 0; k < 3; ++k) {
        if (column[k] < 0 && !p.prescribed[nodes[k].index()]) continue;
        if (column[k] >= 0 && 3 * static_cast<std::size_t>(column[k]) > row) continue;
        const Mat3 block = blocks.hypersingular(b, out.curls[y][k]);
        if (column[k] >= 0)
          out.D.add(row, 3 * static_cast<std::size_t>(column[k]), block);
        else
          f -= block * p.data.displacement[nodes[k]];
      }
      if (p.loaded[y])
        f -= blocks.double_layer(b, p.pairs.double_layer(y, x)[corner]).transpose() * p.data.traction[y];
    }
  }
  add_to(out.f_N, row, f);
}

// Row block of displacement triangle x: V, K and f_D = −V g_N + (½M + K) g_D.
void assemble_triangle_row(const Problem& p, std::size_t x, BodyBlocks& out) {
  const std::size_t row = 3 * static_cast<std::size_t>(out.unknowns.traction[x]);
  Vec3 f = Vec3::Zero();
  for (NodeId node : p.surface.corners[TriId(x)])
    f += 0.5 * out.panels[x].area / 3 * p.data.displacement[node];
  for (std::size_t y = 0; y < out.panels.size(); ++y) {
    const PairBlocks blocks(p.pairs.single_layer(x, y), p.m);
    if (out.unknowns.traction[y] >= 0)
      out.V.add(row, 3 * static_cast<std::size_t>(out.unknowns.traction[y]), blocks.single_layer());
    else if (p.loaded[y])
      f -= blocks.single_layer() * p.data.traction[y];
    const auto& nodes = p.surface.corners[TriId(y)];
    for (int k = 0; k < 3; ++k) {
      const Mat3 block = blocks.double_layer(out.curls[y][k], p.pairs.double_layer(x, y)[k]);
      const int column = out.unknowns.displacement[nodes[k].index()];
      if (column >= 0)
        out.K.add(row, 3 * static_cast<std::size_t>(column), block);
      else
        f += block * p.data.displacement[nodes[k]];
    }
  }
  add_to(out.f_D, row, f);
}

}  // namespace

Unknowns number_unknowns(const TriMesh& surface, const BoundaryData& data) {
  Unknowns u;
  u.displacement.assign(surface.node_count(), 0);
  u.traction.assign(surface.triangle_count(), -1);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (data.kind[t] == BoundaryKind::displacement) {
      u.traction[t] = static_cast<int>(u.traction_count++);
      for (NodeId node : surface.corners[TriId(t)])
        u.displacement[node.index()] = -1;
    }
  for (int& d : u.displacement)
    if (d == 0) d = static_cast<int>(u.displacement_count++);
  return u;
}

BodyBlocks assemble_body(const TriMesh& surface, const BoundaryData& data, const ElasticConstants& m,
                         const PairIntegrator& integrator) {
  BodyBlocks out;
  out.unknowns = number_unknowns(surface, data);
  const std::size_t triangles = surface.triangle_count();
  std::vector<char> loaded(triangles), prescribed(surface.node_count()), needs_double_layer(triangles);
  std::vector<std::vector<std::pair<std::size_t, int>>> around(surface.node_count());
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto& nodes = surface.corners[TriId(t)];
    out.panels.push_back(make_panel(surface.triangle(TriId(t)), nodes));
    out.curls.push_back(surface_curls(out.panels.back()));
    loaded[t] = data.kind[t] == BoundaryKind::traction && data.traction[t] != Vec3::Zero();
    needs_double_layer[t] = loaded[t] || data.kind[t] == BoundaryKind::displacement;
    for (int k = 0; k < 3; ++k) {
      around[nodes[k].index()].emplace_back(t, k);
      prescribed[nodes[k].index()] |= data.kind[t] == BoundaryKind::displacement;
    }
  }
  const PairTable pairs(out.panels, needs_double_layer, integrator);
  const Problem problem{surface, data, m, pairs, std::move(loaded), std::move(prescribed)};
  const std::size_t nu = 3 * out.unknowns.displacement_count, nq = 3 * out.unknowns.traction_count;
  out.D = DenseMatrix(nu, nu);
  out.K = DenseMatrix(nq, nu);
  out.V = DenseMatrix(nq, nq);
  out.f_N.assign(nu, 0.0);
  out.f_D.assign(nq, 0.0);
  parallel_for(surface.node_count(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (out.unknowns.displacement[i] >= 0) assemble_node_row(problem, NodeId(i), around[i], out);
  });
  parallel_for(triangles, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      if (out.unknowns.traction[x] >= 0) assemble_triangle_row(problem, x, out);
  });
  return out;
}

}  // namespace conchoid
