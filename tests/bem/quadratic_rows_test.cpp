#include "conchoid/bem/quadratic_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "conchoid/bem/crack_host.hpp"
#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/pair_memory.hpp"
#include "conchoid/bem/quadratic_body.hpp"
#include "conchoid/bem/quadratic_stress.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlass{7e10, 0.22};

/// A block with a crack in from one side: held in all directions below, along x on another side.
struct Block {
  TriMesh mesh = box_mesh({1, 0.8, 1.2}, 2, 2, 3);
  std::vector<BoundaryKind> kinds;
  CutComplex cut;
  Block() {
    const Vec3 x[] = {Vec3::UnitX()};
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const Vec3 c = centroid(mesh, TriId(t));
      kinds.push_back(c.z() < -0.59  ? BoundaryKind::displacement
                      : c.x() > 0.49 ? BoundaryKind::holding(x)
                                     : BoundaryKind::traction);
    }
    cut =
        corefine(mesh, disc_crack({-0.487, 0.03, 0.07}, {0.1, 0.2, 1}, 0.3, {.edge = 0.13}), {.merge = 0.1});
  }
};

Vec3 block_column(const DenseMatrix& rows, std::size_t row, std::size_t column) {
  return {rows(row, column), rows(row, column + 1), rows(row, column + 2)};
}

}  // namespace

// Linear displacements and constant tractions are among the quadratic and linear ones.
TEST(QuadraticRows, AgreeWithThoseOfLinearElementsWhereTheseAreContained) {
  const Block block;
  const double tolerance = 1e-8;
  const auto quadratic = std::make_shared<const QuadraticBody>(block.mesh, block.kinds, kGlass, tolerance);
  BemSettings settings;
  settings.quadrature_tolerance = tolerance;
  const auto linear = std::make_shared<const BodyOperator>(block.mesh, block.kinds, kGlass, settings);
  settings.quadratic = quadratic;
  const auto both = std::make_shared<const BodyOperator>(block.mesh, block.kinds, kGlass, settings);
  const EnrichedSpace space = make_enriched_space(block.cut, block.mesh, block.kinds);
  std::vector<std::size_t> all(space.functions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  ASSERT_GT(all.size(), 10u);
  const auto rows = make_crack_host(linear)->rows(space, {}, all, nullptr);
  const auto finer = make_crack_host(both)->rows(space, {}, all, nullptr);
  const BodyDiscretisation& d = linear->discretisation();
  const QuadraticSpace& q = quadratic->space();
  double largest = 0, error = 0, largest_traction = 0, traction_error = 0;
  for (std::size_t f = 0; f < all.size(); ++f)
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::size_t i = 0; i < d.free_nodes.size(); ++i) {
        const std::size_t node = d.free_nodes[i].index();
        Vec3 sum = Vec3::Zero();  // of the hat function: 1 in its node, ½ in the middles of edges there
        for (std::size_t k = 0; k < q.free_nodes.size(); ++k) {
          const auto [a, b] = q.ends[q.free_nodes[k]];
          const double value = 0.5 * static_cast<double>((a == node) + (b == node));
          sum += value * block_column(finer[f].body, p, q.tractions() + 3 * k);
        }
        const Vec3 expected = block_column(rows[f].body, p, d.tractions() + 3 * i);
        if (d.unknown_displacement[i].isIdentity(0)) error = std::max(error, (sum - expected).norm());
        largest = std::max(largest, expected.norm());
      }
      for (std::size_t h = 0; h < d.held_triangles.size(); ++h) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t a = 0; a < 3; ++a)
          sum += block_column(finer[f].body, p, 9 * h + 3 * a);
        const Vec3 expected = block_column(rows[f].body, p, 3 * h);
        traction_error = std::max(traction_error, (sum - expected).norm());
        largest_traction = std::max(largest_traction, expected.norm());
      }
    }
  ASSERT_GT(largest * largest_traction, 0);  // and no NaN
  EXPECT_LT(error, 1e-6 * largest);
  EXPECT_LT(traction_error, 1e-6 * largest_traction);
}

// On a stout block both kinds of elements open a crack nearly alike, and stress fields fit together.
TEST(QuadraticRows, ACrackedBlockOpensAsOneOfFineLinearElements) {
  const Block block;
  BoundaryData data = free_surface(block.mesh);
  data.kind = block.kinds;
  for (std::size_t t = 0; t < block.mesh.triangle_count(); ++t)
    if (centroid(block.mesh, TriId(t)).z() > 0.59) data.traction[t] = {0, 0, 1e6};
  const LoadCase load = load_case(block.mesh, data);
  BemSettings settings;
  settings.quadratic = std::make_shared<const QuadraticBody>(block.mesh, block.kinds, kGlass);
  CrackedBody quadratic(std::make_shared<const BodyOperator>(block.mesh, block.kinds, kGlass, settings),
                        as_field(*settings.quadratic, load));
  CrackedBody linear(make_body_operator(block.mesh, data, kGlass), load);
  double volume[2] = {0, 0};
  int i = 0;
  for (CrackedBody* body : {&linear, &quadratic}) {
    body->set_crack(block.cut);
    body->solve();
    for (const Vec3& opening : body->opening())
      volume[i] += opening.z();
    ++i;
  }
  EXPECT_NEAR(volume[1] / volume[0], 1.05, 0.1);
  // In equilibrium: just inside, the traction on a free face is small beside the load.
  const Vec3 inside(-0.2, 0.4 - 0.02, -0.2);
  const Mat3 stress = quadratic.interior_stress(inside);
  EXPECT_LT((stress * Vec3::UnitY()).norm(), 0.15e6);
  EXPECT_NEAR(stress(2, 2), linear.interior_stress(inside)(2, 2), 0.2e6);
  // The prescribed load is refused: it must come as a field.
  EXPECT_THROW(quadratic.set_load(load), InputError);
}

}  // namespace conchoid
