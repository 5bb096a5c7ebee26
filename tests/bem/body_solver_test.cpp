#include "conchoid/bem/body_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

enum class Support { held, balanced };

BoundaryData pulled(const TriMesh& mesh, Support support) {
  BoundaryData data = free_surface(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double z = unit_normal(mesh, TriId(t)).z();
    if (z > 0.9) data.traction[t] = {0, 0, 1e6};
    if (z > -0.9) continue;
    if (support == Support::held)
      data.kind[t] = BoundaryKind::displacement;
    else
      data.traction[t] = {0, 0, -1e6};
  }
  return data;
}

using Matrix = Eigen::MatrixXd;

// | V −K ; Kᵀ D | from the entries.
Matrix matrix_of(const BodyEntries& entries) {
  const BodyDiscretisation& body = entries.body();
  const auto nq = static_cast<Eigen::Index>(body.tractions()),
             nu = static_cast<Eigen::Index>(body.displacements());
  Matrix V(nq, nq), K(nq, nu), D(nu, nu), all(nq + nu, nq + nu);
  entries.single_layer(body.held_triangles, body.held_triangles, {V.data(), 1, body.tractions()});
  entries.double_layer(body.held_triangles, body.free_nodes, {K.data(), 1, body.tractions()});
  entries.hypersingular(body.free_nodes, body.free_nodes, {D.data(), 1, body.displacements()});
  all << V, -K, K.transpose(), D;
  return all;
}

Matrix random_vectors(const BodyOperator& body, Eigen::Index count) {
  // tractions and displacements of sizes that belong together
  Matrix x = Matrix::Random(static_cast<Eigen::Index>(body.discretisation().unknowns()), count);
  x.topRows(static_cast<Eigen::Index>(body.discretisation().tractions())) *= kGlassy.youngs_modulus;
  return x;
}

// Difference of the two halves, each against its own size.
double difference(const BodyOperator& body, const Matrix& a, const Matrix& b) {
  const auto nq = static_cast<Eigen::Index>(body.discretisation().tractions()), nu = a.rows() - nq;
  const double q = nq == 0 ? 0 : (a - b).topRows(nq).norm() / b.topRows(nq).norm();
  return std::max(q, nu == 0 ? 0 : (a - b).bottomRows(nu).norm() / b.bottomRows(nu).norm());
}

// The bytes on which answers may depend: openings, displacements, tractions.
std::vector<double> answers(const CrackedBody& body) {
  std::vector<double> all;
  const auto add = [&](const Vec3& v) { all.insert(all.end(), v.begin(), v.end()); };
  for (const Vec3& v : body.opening())
    add(v);
  for (const Vec3& v : body.displacement())
    add(v);
  for (const Vec3& v : body.traction())
    add(v / kGlassy.youngs_modulus);
  return all;
}

std::vector<double> cracked_answers(const TriMesh& mesh, Support support, const BemSettings& settings) {
  CrackedBody body = make_cracked_body(mesh, pulled(mesh, support), kGlassy, {}, settings);
  for (double radius : {0.2, 0.3}) {
    const TriMesh disc = disc_crack({0.493, 0.02, 0.03}, Vec3::UnitZ(), radius, {.edge = 0.1});
    body.set_crack(corefine(mesh, disc, {.merge = 0.1}));
    body.solve();
  }
  return answers(body);
}

}  // namespace

TEST(BodyEntries, AnEntryHasTheSameBitsInEveryBlock) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2);
  const BodyDiscretisation body(mesh, pulled(mesh, Support::held).kind, kGlassy, 1e-6);
  BodyEntries entries(body);
  const Matrix plain = matrix_of(entries);
  entries.keep_pairs();
  EXPECT_EQ(matrix_of(entries), plain);
  const auto nq = static_cast<Eigen::Index>(body.tractions());
  const std::vector<NodeId> nodes{body.free_nodes[5], body.free_nodes[2]};
  const std::vector<TriId> triangles{body.held_triangles[3]};
  Matrix K(3, 6), D(6, 6);
  entries.double_layer(triangles, nodes, {K.data(), 1, 3});
  entries.hypersingular(nodes, nodes, {D.data(), 1, 6});
  EXPECT_EQ(-K.leftCols(3), plain.block(9, nq + 15, 3, 3));
  EXPECT_EQ(-K.rightCols(3), plain.block(9, nq + 6, 3, 3));
  EXPECT_EQ(D.topRightCorner(3, 3), plain.block(nq + 15, nq + 6, 3, 3));
}

TEST(BodySolver, AppliesTheMatrixOfItsEntries) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 4, 4, 4);
  for (const std::string& name : body_solver_names()) {
    const BodyOperator body(mesh, pulled(mesh, Support::held).kind, kGlassy, {.solver = name});
    const Matrix x = random_vectors(body, 3), exact = matrix_of(body.entries()) * x;
    Matrix y(x.rows(), 3);
    body.solver().apply(x.data(), y.data(), 3);
    EXPECT_LT(difference(body, y, exact), 1e-12) << name;
  }
}

TEST(BodySolver, SolvesWhatItApplies) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 4, 4, 4);
  for (const Support support : {Support::held, Support::balanced})
    for (const std::string& name : body_solver_names()) {
      const BodyOperator body(mesh, pulled(mesh, support).kind, kGlassy, {.solver = name});
      const Matrix x = random_vectors(body, 3);
      Matrix y(x.rows(), 3);
      body.solver().apply(x.data(), y.data(), 3);
      body.solver().solve(y.data(), 3);
      EXPECT_LT(difference(body, y, x), 1e-9) << name;
    }
}

// (J v)ᵀ A⁻¹ w = (P J v)ᵀ M (P J w), from either side.
TEST(BodySolver, ProductsNeedTheFirstStepAlone) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 4, 4, 4);
  for (const Support support : {Support::held, Support::balanced})
    for (const std::string& name : body_solver_names()) {
      const BodyOperator body(mesh, pulled(mesh, support).kind, kGlassy, {.solver = name});
      const auto nq = static_cast<Eigen::Index>(body.discretisation().tractions());
      const Matrix w = random_vectors(body, 3);
      Matrix solved = w, half = w, turned = w;
      turned.topRows(nq) *= -1;
      body.solver().solve(solved.data(), 3);
      body.solver().reduce(half.data(), 3);
      Matrix middle = half;
      body.solver().middle(middle.data(), 3);
      const Matrix whole = turned.transpose() * solved, halves = half.transpose() * middle;
      EXPECT_LT((whole - halves).norm(), 1e-9 * whole.norm()) << name;
      EXPECT_LT((halves - halves.transpose()).norm(), 1e-9 * halves.norm()) << name;
    }
}

TEST(BodySolver, AnotherNameIsRefused) {
  EXPECT_THROW(BodyOperator({}, {}, kGlassy, {.solver = "magic"}), InputError);
  EXPECT_EQ(body_solver_names().front(), BemSettings{}.solver);
}

TEST(BodySolver, EverySolverGivesTheSameCrackedBody) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 3, 3, 3);
  for (const Support support : {Support::held, Support::balanced}) {
    const std::vector<double> dense = cracked_answers(mesh, support, {});
    double size = 0;
    for (double v : dense)
      size = std::max(size, std::abs(v));
    for (const std::string& name : body_solver_names()) {
      const std::vector<double> other = cracked_answers(mesh, support, {.solver = name});
      ASSERT_EQ(other.size(), dense.size());
      double worst = 0;
      for (std::size_t i = 0; i < dense.size(); ++i)
        worst = std::max(worst, std::abs(other[i] - dense[i]));
      EXPECT_LT(worst, 1e-9 * size) << name;
    }
  }
}

TEST(BodySolver, SameBitsForEveryNumberOfThreads) {
  for (const std::string& name : body_solver_names()) {
    const int cells = name == "dense" ? 4 : 2;  // 4: more than one tile
    const TriMesh mesh = box_mesh({1, 1, 1}, cells, cells, cells);
    std::vector<std::vector<double>> all;
    for (int threads : {1, 2, 5})
      all.push_back(ExecutionContext(threads).run(
          [&] { return cracked_answers(mesh, Support::held, {.solver = name}); }));
    EXPECT_EQ(all[0], all[1]) << name;
    EXPECT_EQ(all[0], all[2]) << name;
  }
}

// 9 n² (1 + h)² bytes, n triangles of which a share h is held, and half a row of tiles each.
TEST(BodySolver, MemoryOfABodyIsAsStated) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 5, 5, 5);
  const auto n = static_cast<double>(mesh.triangle_count());
  for (const auto& [support, h] : {std::pair{Support::balanced, 0.0}, {Support::held, 1.0 / 6}}) {
    const BodyOperator body(mesh, pulled(mesh, support).kind, kGlassy, {.quadrature_tolerance = 1e-3});
    const double factors = 9 * n * n * (1 + h) * (1 + h);
    const double half_tiles = 8 * 96.0 * static_cast<double>(body.discretisation().unknowns());
    const auto bytes = static_cast<double>(body.bytes());
    EXPECT_GT(bytes, 0.8 * factors);
    EXPECT_LT(bytes, 1.1 * factors + half_tiles);
    RecordProperty("bytes", std::to_string(body.bytes()));
  }
}

}  // namespace conchoid
