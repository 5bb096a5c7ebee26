#include "conchoid/bem/body_entries.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <type_traits>

#include "conchoid/bem/block_projection.hpp"
#include "conchoid/bem/load_case.hpp"
#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

void add(const BlockView& out, std::size_t i, std::size_t j, const Mat3& block) {
  double* at = out.data + 3 * i * out.row + 3 * j * out.column;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q)
      at[p * out.row + q * out.column] += block(p, q);
}

void clear(const BlockView& out, std::size_t rows, std::size_t columns) {
  for (std::size_t i = 0; i < 3 * rows; ++i)
    for (std::size_t j = 0; j < 3 * columns; ++j)
      out.data[i * out.row + j * out.column] = 0;
}

// P B Q of each block, and s (I − P) more where a row meets itself.
template <class Row, class Column>
void project(const BlockView& out, std::span<const Row> rows, std::span<const Column> columns,
             const std::vector<int>& row_unknown, const std::vector<Mat3>& row_projection,
             const std::vector<int>& column_unknown, const std::vector<Mat3>& column_projection) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Mat3& Q = column_projection[static_cast<std::size_t>(column_unknown[columns[j].index()])];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Mat3& P = row_projection[static_cast<std::size_t>(row_unknown[rows[i].index()])];
      bool itself = false;
      if constexpr (std::is_same_v<Row, Column>) itself = rows[i] == columns[j];
      project_block(out.data + 3 * i * out.row + 3 * j * out.column, out.row, out.column, P, Q, itself);
    }
  }
}

// Kept pairs of a block lie all over memory: as many are on their way while one is worked on.
constexpr std::size_t kPairsAhead = 8;

std::vector<std::size_t> triangles_around(const BodyDiscretisation& body, std::span<const NodeId> nodes) {
  std::vector<char> around(body.panels.size(), 0);
  for (NodeId node : nodes)
    for (const CornerAt& c : body.around[node.index()])
      around[c.triangle] = 1;
  std::vector<std::size_t> all;
  for (std::size_t t = 0; t < around.size(); ++t)
    if (around[t] != 0) all.push_back(t);
  return all;
}

// Per corner of some triangles: the column of its node, or −1.
std::vector<std::array<int, 3>> columns_of_corners(const BodyDiscretisation& body,
                                                   const std::vector<std::size_t>& triangles,
                                                   std::span<const NodeId> nodes) {
  std::vector<int> column(body.surface.node_count(), -1);
  for (std::size_t j = 0; j < nodes.size(); ++j)
    column[nodes[j].index()] = static_cast<int>(j);
  std::vector<std::array<int, 3>> out;
  for (std::size_t t : triangles) {
    const auto& c = body.surface.corners[TriId(t)];
    out.push_back({column[c[0].index()], column[c[1].index()], column[c[2].index()]});
  }
  return out;
}

}  // namespace

BodyDiscretisation::BodyDiscretisation(TriMesh s, std::vector<BoundaryKind> k, const ElasticConstants& c,
                                       double quadrature_tolerance)
    : surface(std::move(s)), kinds(std::move(k)), m(c), integrator(quadrature_tolerance) {
  if (kinds.size() != surface.triangle_count())
    throw InputError("body: " + std::to_string(kinds.size()) + " kinds of conditions for a surface of " +
                     std::to_string(surface.triangle_count()) + " triangles; give one for each");
  around.resize(surface.node_count());
  traction_unknown.assign(surface.triangle_count(), -1);
  displacement_unknown.assign(surface.node_count(), -1);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const auto& nodes = surface.corners[TriId(t)];
    panels.push_back(make_panel(surface.triangle(TriId(t)), nodes));
    curls.push_back(surface_curls(panels.back()));
    for (int corner = 0; corner < 3; ++corner)
      around[nodes[corner].index()].push_back({t, corner});
    if (kinds[t].holds_nothing()) continue;
    traction_unknown[t] = static_cast<int>(held_triangles.size());
    held_triangles.emplace_back(t);
    unknown_traction.push_back(kinds[t].held());
  }
  const std::vector<Mat3> held = held_at_nodes(surface, kinds);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i].isIdentity(0)) continue;
    displacement_unknown[i] = static_cast<int>(free_nodes.size());
    free_nodes.emplace_back(i);
    unknown_displacement.push_back(Mat3::Identity() - held[i]);
  }
}

void BodyDiscretisation::keep_unknown(double* x) const {
  const auto project = [](const std::vector<Mat3>& onto, double* at) {
    for (std::size_t i = 0; i < onto.size(); ++i)
      if (!onto[i].isIdentity(0)) {
        Eigen::Map<Vec3> value(at + 3 * i);
        value = (onto[i] * value).eval();
      }
  };
  project(unknown_traction, x);
  project(unknown_displacement, x + tractions());
}

void BodyEntries::keep_pairs() {
  const std::size_t n = body_.panels.size();
  pairs_.resize(n * (n + 1) / 2);
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  parallel_for(n, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      body_.integrator.single_layer(pairs_with(x, std::span(all).first(x + 1)), &pairs_[x * (x + 1) / 2]);
  });
}

std::vector<PanelPair> BodyEntries::pairs_with(std::size_t x, std::span<const std::size_t> others) const {
  std::vector<PanelPair> pairs;
  pairs.reserve(others.size());
  for (const std::size_t y : others)
    pairs.push_back({&body_.panels[x], &body_.panels[y]});
  return pairs;
}

std::vector<SingleLayerPair> BodyEntries::row(std::size_t x, std::span<const std::size_t> others) const {
  std::vector<SingleLayerPair> out(others.size());
  if (pairs_.empty()) {
    body_.integrator.single_layer(pairs_with(x, others), out.data());
    return out;
  }
  const auto place = [&](std::size_t y) {
    return &pairs_[x < y ? y * (y + 1) / 2 + x : x * (x + 1) / 2 + y];
  };
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (i + kPairsAhead < others.size()) __builtin_prefetch(place(others[i + kPairsAhead]));
    out[i] = *place(others[i]);
  }
  return out;
}

void BodyEntries::single_layer(std::span<const TriId> rows, std::span<const TriId> columns,
                               BlockView out) const {
  clear(out, rows.size(), columns.size());
  std::vector<std::size_t> trial;
  for (const TriId t : columns)
    trial.push_back(t.index());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<SingleLayerPair> pairs = row(rows[i].index(), trial);
    for (std::size_t j = 0; j < trial.size(); ++j)
      add(out, i, j, PairBlocks(pairs[j], body_.m).single_layer());
  }
}

void BodyEntries::double_layer(std::span<const TriId> rows, std::span<const NodeId> columns,
                               BlockView out) const {
  clear(out, rows.size(), columns.size());
  const std::vector<std::size_t> trial = triangles_around(body_, columns);
  const auto column = columns_of_corners(body_, trial, columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t x = rows[i].index();
    const std::vector<SingleLayerPair> pairs = row(x, trial);
    std::vector<DoubleLayerPair> laplace(trial.size());
    body_.integrator.double_layer(pairs_with(x, trial), laplace.data());
    for (std::size_t t = 0; t < trial.size(); ++t) {
      const PairBlocks blocks(pairs[t], body_.m);
      for (int k = 0; k < 3; ++k)
        if (column[t][k] >= 0)
          add(out, i, static_cast<std::size_t>(column[t][k]),
              blocks.double_layer(body_.curls[trial[t]][k], laplace[t][k]));
    }
  }
}

void BodyEntries::hypersingular(std::span<const NodeId> rows, std::span<const NodeId> columns,
                                BlockView out) const {
  clear(out, rows.size(), columns.size());
  const std::vector<std::size_t> test = triangles_around(body_, rows),
                                 trial = triangles_around(body_, columns);
  const auto line = columns_of_corners(body_, test, rows), column = columns_of_corners(body_, trial, columns);
  std::vector<PairBlocks::TrialSum> sums(columns.size());  // per column, as one test triangle sees it
  for (std::size_t s = 0; s < test.size(); ++s) {
    std::fill(sums.begin(), sums.end(), PairBlocks::TrialSum());
    const std::vector<SingleLayerPair> pairs = row(test[s], trial);
    for (std::size_t t = 0; t < trial.size(); ++t) {
      const PairBlocks blocks(pairs[t], body_.m);
      for (int b = 0; b < 3; ++b)
        if (column[t][b] >= 0)
          sums[static_cast<std::size_t>(column[t][b])].add(blocks, body_.curls[trial[t]][b]);
    }
    for (int a = 0; a < 3; ++a)
      for (std::size_t j = 0; line[s][a] >= 0 && j < sums.size(); ++j)
        add(out, static_cast<std::size_t>(line[s][a]), j, sums[j].tested(body_.curls[test[s]][a]));
  }
}

void BodyEntries::system_single_layer(std::span<const TriId> rows, std::span<const TriId> columns,
                                      BlockView out) const {
  single_layer(rows, columns, out);
  project(out, rows, columns, body_.traction_unknown, body_.unknown_traction, body_.traction_unknown,
          body_.unknown_traction);
}

void BodyEntries::system_double_layer(std::span<const TriId> rows, std::span<const NodeId> columns,
                                      BlockView out) const {
  double_layer(rows, columns, out);
  project(out, rows, columns, body_.traction_unknown, body_.unknown_traction, body_.displacement_unknown,
          body_.unknown_displacement);
}

void BodyEntries::system_hypersingular(std::span<const NodeId> rows, std::span<const NodeId> columns,
                                       BlockView out) const {
  hypersingular(rows, columns, out);
  project(out, rows, columns, body_.displacement_unknown, body_.unknown_displacement,
          body_.displacement_unknown, body_.unknown_displacement);
}

}  // namespace conchoid
