#include "conchoid/bem/quadratic_body.hpp"

#include <algorithm>
#include <optional>

#include "conchoid/bem/block_projection.hpp"
#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/quadratic_blocks.hpp"
#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kBatch = 32;  // panels whose rows of D are made before they are added to its tiles
constexpr std::size_t kRows = 18;   // of a panel

QuadraticBlocks blocks_of(const QuadraticSpace& s, std::size_t x, std::size_t y) {
  return QuadraticBlocks(s.integrator.single_layer(s.corners.panels[x], s.corners.panels[y]), s.corners.m);
}

QuadraticBlocks::Mixed double_layer_of(const QuadraticSpace& s, const QuadraticBlocks& blocks, std::size_t x,
                                       std::size_t y) {
  return blocks.double_layer(s.corners.curls[y],
                             s.integrator.double_layer(s.corners.panels[x], s.corners.panels[y]));
}

/// Rows of D that belong to the nodes of one panel x, from pairs with y ≤ x, half of (x, x): D is the sum of these
/// and their transposes.
using Strip = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void fill_strip(const QuadraticSpace& s, std::size_t x, Strip& strip) {
  strip.setZero(kRows, static_cast<Eigen::Index>(s.displacements()));
  for (std::size_t y = 0; y <= x; ++y) {
    QuadraticBlocks::Displacements D =
        blocks_of(s, x, y).hypersingular(s.corners.curls[x], s.corners.curls[y]);
    if (y == x) D *= 0.5;
    for (std::size_t l = 0; l < 6; ++l)
      if (const int column = s.unknown[s.nodes[y][l]]; column >= 0)
        strip.middleCols<3>(3 * column) += D.middleCols<3>(static_cast<Eigen::Index>(3 * l));
  }
}

/// What strips of consecutive panels add to a tile.
void add_strips(const QuadraticSpace& s, std::size_t first, const std::vector<Strip>& strips,
                const TiledCholesky::Tile& tile) {
  const auto inside = [](std::size_t i, std::size_t from, std::size_t count) {
    return i >= from && i < from + count;
  };
  Eigen::Map<Eigen::MatrixXd> to(tile.data, static_cast<Eigen::Index>(tile.rows),
                                 static_cast<Eigen::Index>(tile.columns));
  for (std::size_t b = 0; b < strips.size(); ++b)
    for (std::size_t k = 0; k < 6; ++k) {
      const int unknown = s.unknown[s.nodes[first + b][k]];
      if (unknown < 0) continue;
      const std::size_t at = 3 * static_cast<std::size_t>(unknown);
      const auto rows = strips[b].middleRows<3>(static_cast<Eigen::Index>(3 * k));
      if (inside(at, tile.row, tile.rows))
        to.middleRows<3>(static_cast<Eigen::Index>(at - tile.row)) +=
            rows.middleCols(static_cast<Eigen::Index>(tile.column), static_cast<Eigen::Index>(tile.columns));
      if (inside(at, tile.column, tile.columns))
        to.middleCols<3>(static_cast<Eigen::Index>(at - tile.column)) +=
            rows.middleCols(static_cast<Eigen::Index>(tile.row), static_cast<Eigen::Index>(tile.rows))
                .transpose();
    }
}

/// Projections of the unknowns in a tile's rows and columns, three unknowns each.
template <class Projection>
void project_tile(const TiledCholesky::Tile& tile, const Projection& projection) {
  for (std::size_t j = 0; j < tile.columns; j += 3)
    for (std::size_t i = 0; i < tile.rows; i += 3)
      project_block(tile.data + j * tile.rows + i, 1, tile.rows, projection((tile.row + i) / 3),
                    projection((tile.column + j) / 3), tile.row + i == tile.column + j);
}

}  // namespace

QuadraticBody::QuadraticBody(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                             double quadrature_tolerance, const std::shared_ptr<const ByteCache>& cache)
    : space_(std::make_shared<const QuadraticSpace>(std::move(surface), std::move(kinds), m,
                                                    quadrature_tolerance)),
      factors_(space_->tractions(), space_->displacements()) {
  const BodyDiscretisation& body = space_->corners;
  const KeptSystem kept = kept_system(cache, "quadratic", body.surface, body.kinds, m, quadrature_tolerance);
  if (kept.cache)
    if (const std::optional<KeptBytes> known = kept.cache->recall(kept.name)) {
      ByteReader in(known->bytes);
      factors_.get(in);
      return;
    }
  make_factors();
  if (!kept.cache) return;
  ByteWriter out;
  factors_.put(out);
  kept.cache->keep(kept.name, out.bytes());
}

void QuadraticBody::make_factors() {
  assemble_single_layer();
  factors_.factor_single_layer();
  assemble_double_layer();
  factors_.reduce_coupling();
  assemble_hypersingular();
  RigidMotions motions;
  for (const auto& motion : floating_motions(space_->corners.surface, space_->corners.kinds))
    motions.push_back(space_->on_free_nodes(motion));
  factors_.factor(motions);
}

// Panel by panel; the rows of one are written by one task.
void QuadraticBody::assemble_single_layer() {
  const QuadraticSpace& s = *space_;
  const auto& held = s.corners.held_triangles;
  const std::vector<TiledCholesky::Tile> tiles = factors_.V().tiles();
  constexpr std::size_t size = TiledCholesky::kTile;
  parallel_for(held.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      for (std::size_t y = 0; y <= x; ++y) {
        const QuadraticBlocks::Tractions V = blocks_of(s, held[x].index(), held[y].index()).single_layer();
        for (std::size_t j = 0; j < 9; ++j)
          for (std::size_t i = 0; i < 9; ++i) {
            const std::size_t row = 9 * x + i, column = 9 * y + j, I = row / size, J = column / size;
            if (I < J) continue;
            const TiledCholesky::Tile& t = tiles[I * (I + 1) / 2 + J];
            t.data[(column - t.column) * t.rows + row - t.row] =
                V(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          }
      }
  });
  const auto& part = s.corners.unknown_traction;
  parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      project_tile(tiles[t], [&](std::size_t i) -> const Mat3& { return part[i / 3]; });
  });
}

void QuadraticBody::assemble_double_layer() {
  const QuadraticSpace& s = *space_;
  const auto& held = s.corners.held_triangles;
  const std::size_t n = factors_.tractions();
  double* W = factors_.W().data();
  parallel_for(held.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) {
      const std::size_t x = held[h].index();
      double* rows = W + 9 * h;
      for (std::size_t y = 0; y < s.nodes.size(); ++y) {
        const QuadraticBlocks::Mixed K = double_layer_of(s, blocks_of(s, x, y), x, y);
        for (std::size_t l = 0; l < 6; ++l)
          if (const int column = s.unknown[s.nodes[y][l]]; column >= 0)
            for (std::size_t q = 0; q < 3; ++q)
              for (std::size_t i = 0; i < 9; ++i)
                rows[(3 * static_cast<std::size_t>(column) + q) * n + i] +=
                    K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(3 * l + q));
      }
      for (std::size_t j = 0; j < s.free_nodes.size(); ++j)
        for (std::size_t a = 0; a < 3; ++a)
          project_block(rows + 3 * j * n + 3 * a, 1, n, s.corners.unknown_traction[h], s.unknown_part[j],
                        false);
    }
  });
}

void QuadraticBody::assemble_hypersingular() {
  const QuadraticSpace& s = *space_;
  const std::vector<TiledCholesky::Tile> tiles = factors_.S().tiles();
  for (std::size_t first = 0; first < s.nodes.size(); first += kBatch) {
    std::vector<Strip> strips(std::min(kBatch, s.nodes.size() - first));
    parallel_for(strips.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        fill_strip(s, first + b, strips[b]);
    });
    parallel_for(tiles.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        add_strips(s, first, strips, tiles[t]);
    });
  }
  parallel_for(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      project_tile(tiles[t], [&](std::size_t i) -> const Mat3& { return s.unknown_part[i]; });
  });
}

// f_D and f_N of (B1), panel by panel.
std::vector<double> QuadraticBody::right_hand_side(const QuadraticData& data) const {
  const QuadraticSpace& s = *space_;
  using Nine = Eigen::Matrix<double, 9, 1>;
  using Eighteen = Eigen::Matrix<double, 18, 1>;
  const std::size_t n = s.nodes.size();
  std::vector<Nine> g_N(n), f_D(n, Nine::Zero());
  std::vector<Eighteen> g_D(n), f_N(n, Eighteen::Zero());
  for (std::size_t y = 0; y < n; ++y) {
    g_N[y] << data.traction[y][0], data.traction[y][1], data.traction[y][2];
    for (std::size_t k = 0; k < 6; ++k)
      g_D[y].segment<3>(static_cast<Eigen::Index>(3 * k)) = data.displacement[s.nodes[y][k]];
  }
  parallel_for(n, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x) {
      const bool held = s.corners.traction_unknown[x] >= 0;
      const Eigen::Matrix<double, 3, 6> M = 0.5 * quadratic_mass(s.corners.panels[x].area);
      for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 6; ++k) {
          f_D[x].segment<3>(3 * a) += M(a, k) * g_D[x].segment<3>(3 * k);
          f_N[x].segment<3>(3 * k) += M(a, k) * g_N[x].segment<3>(3 * a);
        }
      for (std::size_t y = 0; y < n; ++y) {
        const bool traction = !g_N[y].isZero(0), displacement = !g_D[y].isZero(0);
        if (!traction && !displacement) continue;
        const QuadraticBlocks blocks = blocks_of(s, x, y);
        if (traction) {
          if (held) f_D[x] -= blocks.single_layer() * g_N[y];
          f_N[x] -= double_layer_of(s, blocks_of(s, y, x), y, x).transpose() * g_N[y];
        }
        if (displacement) {
          if (held) f_D[x] += double_layer_of(s, blocks, x, y) * g_D[y];
          f_N[x] -= blocks.hypersingular(s.corners.curls[x], s.corners.curls[y]) * g_D[y];
        }
      }
    }
  });
  std::vector<double> f(factors_.size(), 0.0);
  for (std::size_t x = 0; x < n; ++x) {
    if (const int h = s.corners.traction_unknown[x]; h >= 0)
      for (std::size_t a = 0; a < 3; ++a) {
        Eigen::Map<Vec3> at(&f[9 * static_cast<std::size_t>(h) + 3 * a]);
        at = s.corners.unknown_traction[static_cast<std::size_t>(h)] *
             f_D[x].segment<3>(static_cast<Eigen::Index>(3 * a));
      }
    for (std::size_t k = 0; k < 6; ++k)
      if (const int u = s.unknown[s.nodes[x][k]]; u >= 0) {
        Eigen::Map<Vec3> at(&f[factors_.tractions() + 3 * static_cast<std::size_t>(u)]);
        at +=
            s.unknown_part[static_cast<std::size_t>(u)] * f_N[x].segment<3>(static_cast<Eigen::Index>(3 * k));
      }
  }
  return f;
}

QuadraticSolution QuadraticBody::solve(const LoadCase& load) const {
  const QuadraticSpace& s = *space_;
  require_fitting_load(s.corners.surface, s.corners.kinds, load);
  QuadraticData data(s, load);
  std::vector<double> x = right_hand_side(data);
  factors_.solve(x.data());
  QuadraticSolution out{space_, std::move(data.displacement), std::move(data.traction), load.ambient};
  for (std::size_t h = 0; h < s.corners.held_triangles.size(); ++h)
    for (std::size_t a = 0; a < 3; ++a)
      out.traction[s.corners.held_triangles[h].index()][a] +=
          s.corners.unknown_traction[h] * Eigen::Map<const Vec3>(&x[9 * h + 3 * a]);
  for (std::size_t i = 0; i < s.free_nodes.size(); ++i)
    out.displacement[s.free_nodes[i]] +=
        s.unknown_part[i] * Eigen::Map<const Vec3>(&x[factors_.tractions() + 3 * i]);
  return out;
}

}  // namespace conchoid
