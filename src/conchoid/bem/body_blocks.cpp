#include "conchoid/bem/body_blocks.hpp"

#include <algorithm>

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

// Row block of node i: D against all nodes before it and itself.
void assemble_node_row(const TriMesh& surface, const ElasticConstants& m, const PairTable& pairs, NodeId node,
                       const CornersAround& around, BodyBlocks& out) {
  const std::size_t row = 3 * static_cast<std::size_t>(out.unknowns.displacement[node.index()]);
  const auto wanted = [&](NodeId other) {
    const int column = out.unknowns.displacement[other.index()];
    return column >= 0 && 3 * static_cast<std::size_t>(column) <= row;
  };
  for (const auto& [x, corner] : around)
    for (std::size_t y = 0; y < out.panels.size(); ++y) {
      const auto& nodes = surface.corners[TriId(y)];
      if (std::none_of(nodes.begin(), nodes.end(), wanted)) continue;
      const PairBlocks blocks(pairs.single_layer(x, y), m);
      for (int k = 0; k < 3; ++k)
        if (wanted(nodes[k]))
          out.D.add(row, 3 * static_cast<std::size_t>(out.unknowns.displacement[nodes[k].index()]),
                    blocks.hypersingular(out.curls[x][corner], out.curls[y][k]));
    }
}

// Row block of displacement triangle x: V and K.
void assemble_triangle_row(const TriMesh& surface, const ElasticConstants& m, const PairTable& pairs,
                           std::size_t x, BodyBlocks& out) {
  const std::size_t row = 3 * static_cast<std::size_t>(out.unknowns.traction[x]);
  for (std::size_t y = 0; y < out.panels.size(); ++y) {
    const PairBlocks blocks(pairs.single_layer(x, y), m);
    if (const int q = out.unknowns.traction[y]; q >= 0)
      out.V.add(row, 3 * static_cast<std::size_t>(q), blocks.single_layer());
    const auto& nodes = surface.corners[TriId(y)];
    for (int k = 0; k < 3; ++k)
      if (const int column = out.unknowns.displacement[nodes[k].index()]; column >= 0)
        out.K.add(row, 3 * static_cast<std::size_t>(column),
                  blocks.double_layer(out.curls[y][k], pairs.double_layer(x, y)[k]));
  }
}

}  // namespace

std::vector<CornersAround> corners_around_nodes(const TriMesh& surface) {
  std::vector<CornersAround> around(surface.node_count());
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      around[surface.corners[TriId(t)][k].index()].emplace_back(t, k);
  return around;
}

Unknowns number_unknowns(const TriMesh& surface, const std::vector<BoundaryKind>& kinds) {
  Unknowns u;
  u.displacement.assign(surface.node_count(), 0);
  u.traction.assign(surface.triangle_count(), -1);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (kinds[t] == BoundaryKind::displacement) {
      u.traction[t] = static_cast<int>(u.traction_count++);
      for (NodeId node : surface.corners[TriId(t)])
        u.displacement[node.index()] = -1;
    }
  for (int& d : u.displacement)
    if (d == 0) d = static_cast<int>(u.displacement_count++);
  return u;
}

BodyBlocks assemble_body(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                         const ElasticConstants& m, const PairIntegrator& integrator) {
  BodyBlocks out;
  out.unknowns = number_unknowns(surface, kinds);
  const std::size_t triangles = surface.triangle_count();
  std::vector<char> needs_double_layer(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    out.panels.push_back(make_panel(surface.triangle(TriId(t)), surface.corners[TriId(t)]));
    out.curls.push_back(surface_curls(out.panels.back()));
    needs_double_layer[t] = kinds[t] == BoundaryKind::displacement;
  }
  const std::vector<CornersAround> around = corners_around_nodes(surface);
  const PairTable pairs(out.panels, needs_double_layer, integrator);
  const std::size_t nu = 3 * out.unknowns.displacement_count, nq = 3 * out.unknowns.traction_count;
  out.D = DenseMatrix(nu, nu);
  out.K = DenseMatrix(nq, nu);
  out.V = DenseMatrix(nq, nq);
  parallel_for(surface.node_count(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (out.unknowns.displacement[i] >= 0) assemble_node_row(surface, m, pairs, NodeId(i), around[i], out);
  });
  parallel_for(triangles, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      if (out.unknowns.traction[x] >= 0) assemble_triangle_row(surface, m, pairs, x, out);
  });
  return out;
}

}  // namespace conchoid
